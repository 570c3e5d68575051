// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "model/snapshot.h"

class QLabel;

namespace transillum::viewer {

/// Statistics of the scene and of the solve, and the directions that an accuracy of 1 % requires.
class SolveSummary : public QWidget {
  Q_OBJECT

 public:
  explicit SolveSummary(QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);

 private:
  void show_error(const SolverSnapshot& snapshot);
  void show_directions_needed(const SolverSnapshot& snapshot);

  QLabel *patches_, *fragments_, *transfers_, *form_factors_, *closure_, *escaped_, *negative_,
      *lobes_, *energy_, *contraction_, *error_, *bound_, *estimate_;
};

}  // namespace transillum::viewer
