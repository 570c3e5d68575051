// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "model/requests/slow_quantities.h"
#include "model/snapshot.h"

class QLabel;

namespace transillum::viewer {

class ValueGrid;

/// Statistics of the scene and of the solve, and the directions that an accuracy of 1 % requires.
class SolveSummary : public QWidget {
  Q_OBJECT

 public:
  explicit SolveSummary(QWidget* parent = nullptr);

  void show_snapshot(const SolverSnapshot& snapshot);
  /// Shows the cost of passes; without it the reason, or, if that is empty, a link to measure it.
  void show_costs(const std::shared_ptr<const MeasuredCosts>& measured, const QString& missing);

 signals:
  void costs_wanted();

 private:
  void add_cost_rows(ValueGrid& grid);
  void show_error(const SolverSnapshot& snapshot);
  void show_directions_needed(const SolverSnapshot& snapshot);

  QLabel *patches_, *fragments_, *transfers_, *form_factors_, *closure_, *escaped_, *negative_,
      *lobes_, *energy_, *contraction_, *error_, *bound_, *estimate_, *time_, *candidates_, *exact_,
      *costly_;
};

}  // namespace transillum::viewer
