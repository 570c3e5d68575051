// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "snapshot.h"

namespace transillum::viewer {

class LogChart;

/// How the solve converges: from step to step, and within the step under way.
class ConvergenceView : public QWidget {
  Q_OBJECT

 public:
  explicit ConvergenceView(QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);

 private:
  LogChart* steps_;
  LogChart* passes_;
};

}  // namespace transillum::viewer
