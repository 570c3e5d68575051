// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/measured_errors.h"

#include <QCoreApplication>
#include <algorithm>
#include <utility>

#include "model/snapshot_values.h"
#include "support/number_text.h"
#include "transillum/errors.h"

namespace transillum::viewer {

bool MeasuredErrors::are_of(const SolverSnapshot& snapshot) const {
  return snapshot.loaded == loaded && !snapshot.materials && snapshot.progress.finished &&
         snapshot.radiosity == solve.solution.radiosity;
}

QString why_not_measurable(const SolverSnapshot& snapshot) {
  try {
    check_measurable(snapshot.options, snapshot.glossy != nullptr);
  } catch (const InputError& error) {
    return capitalized(QString::fromUtf8(error.what()));
  }
  return {};
}

MeasuredSolve measured_solve(const SolverSnapshot& snapshot) {
  check_measurable(snapshot.options, snapshot.glossy != nullptr);
  MeasuredSolve solve;
  solve.solution = solution_of(snapshot);
  solve.options = snapshot.options;
  solve.options.directions = std::max(1, solve.solution.statistics.passes);
  solve.options.replicas = std::max(1, solve.solution.error.replicas);
  solve.tree = snapshot.loaded->tree;
  solve.directions = *snapshot.directions;
  if (snapshot.shot && !snapshot.shot->sources.empty()) {
    solve.shot = snapshot.shot;
  }
  return solve;
}

MeasuredErrors measure(const SolverSnapshot& snapshot, const Cancellation& cancellation,
                       const MeasurementObserver& observer) {
  MeasuredErrors errors{snapshot.loaded, measured_solve(snapshot), {}};
  errors.report = measure_errors(errors.solve, cancellation, observer);
  return errors;
}

QString text_of(Measurement what) {
  const char* text = what == Measurement::replicas  ? "Directions: solving with replicas"
                     : what == Measurement::engines ? "Method: comparing engines"
                                                    : "Patches: solving with all of them divided";
  return QCoreApplication::translate("MeasuredErrors", text);
}

MeasurementObserver by_percent(std::function<void(Measurement, int percent)> observer) {
  return [observer = std::move(observer), newest = std::pair(Measurement::replicas, -1)](
             Measurement what, double fraction) mutable {
    const auto now = std::pair(what, static_cast<int>(100 * fraction));
    if (std::exchange(newest, now) != now) {
      observer(now.first, now.second);
    }
  };
}

}  // namespace transillum::viewer
