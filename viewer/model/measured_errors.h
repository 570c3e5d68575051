// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <functional>
#include <memory>

#include "model/snapshot.h"
#include "session/measure_errors.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// The errors of a finished solve by surface and cause. Immutable.
struct MeasuredErrors {
  std::shared_ptr<const LoadedScene> loaded;
  MeasuredSolve solve;
  ErrorReport report;

  /// Whether `snapshot` shows the solve that was measured.
  bool are_of(const SolverSnapshot& snapshot) const;
};

/// Why the errors of such a solve cannot be measured, for the user; empty if they can once it has
/// finished.
QString why_not_measurable(const SolverSnapshot& snapshot);
/// The solve of a snapshot that shows the end of it, with the scene's own materials.
/// @throws InputError as check_measurable()
MeasuredSolve measured_solve(const SolverSnapshot& snapshot);
/// Measures the errors of measured_solve(). Any thread.
/// @throws exceptions of measure_errors()
MeasuredErrors measure(const SolverSnapshot& snapshot, const Cancellation& cancellation,
                       const MeasurementObserver& observer);
/// The measurement that is made, for the user.
QString text_of(Measurement what);
/// An observer that passes whole percents on, when they have changed.
MeasurementObserver by_percent(std::function<void(Measurement, int percent)> observer);

}  // namespace transillum::viewer
