// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "model/snapshot.h"
#include "state/focus.h"
#include "transillum/line_chart.h"

namespace transillum::viewer {

class LogChart;

/// How the solve converges: from step to step, and within the step under way. The moment in focus
/// is marked, and a click goes to another.
class ConvergenceView : public QWidget {
  Q_OBJECT

 public:
  explicit ConvergenceView(Focus& focus, QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);
  /// As they are shown, from above.
  std::vector<LineChart> charts() const;

 private:
  void show_position();

  Focus& focus_;
  LogChart* steps_;
  LogChart* passes_;
  int shown_iteration_ = 0;  ///< that of passes_, from 0
};

/// What the changes of B per iteration stay below by eq. 22 and 25, given the first: for the steps
/// done and some more, up to the tolerance. Empty where nothing is promised.
std::vector<double> predicted_changes(const SolverSnapshot& snapshot);

}  // namespace transillum::viewer
