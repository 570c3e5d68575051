// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "io/drawing/line_chart.h"
#include "model/snapshot.h"
#include "state/focus.h"

namespace transillum::viewer {

class LogChart;

/// Convergence of the solve in two charts: the change of B per iteration, and within the current
/// iteration. The position in focus is marked; a click moves the focus.
class ConvergenceView : public QWidget {
  Q_OBJECT

 public:
  explicit ConvergenceView(Focus& focus, QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);
  /// The charts as shown, from top to bottom.
  std::vector<LineChart> charts() const;

 private:
  void show_position();

  Focus& focus_;
  LogChart* iteration_chart_;
  LogChart* direction_chart_;
  int shown_iteration_ = 0;  ///< iteration of direction_chart_, from 0
};

/// Upper bounds of the change of B in each iteration by eqs. 22 and 25, given the first change: for
/// the iterations done and some more, down to the tolerance. Empty where the equations give none.
std::vector<double> predicted_changes(const SolverSnapshot& snapshot);

}  // namespace transillum::viewer
