// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The stages of a solve to a total error. Input: a scene and options; each stage solves to an
// accuracy of directions, measures all errors, and divides the patches that are worst.
#include "session/total_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "radiosity/error/surfaces.h"
#include "radiosity/state_archive.h"
#include "scene/build/division.h"
#include "scene/build/patch_count.h"
#include "session/divisions.h"
#include "session/next_steps.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Share of the total that directions may have.
constexpr double directions_fraction = 1.0 / 3;
/// While patches are too large, directions need not be better than this fraction of their error.
constexpr double early_fraction = 0.1;
/// Error of directions of the first stage.
constexpr double first_directions = 0.03;
/// Share of what is left for patches that they may take, so that an estimate that is a little too
/// small takes no further stage.
constexpr double caution = 0.9;
/// Least fraction of the total that is asked of directions.
constexpr double least_directions_fraction = 0.05;

/// The error that the patches of a surface may have.
double allowed_for_patches(const CauseErrors& errors, double total) {
  const double others =
      std::min(errors.directions, directions_fraction * total) + errors.iterations + errors.method;
  return caution * std::max(directions_fraction * total, total - others);
}

}  // namespace

std::string end_text(TotalEnd end, std::int64_t most_patches) {
  switch (end) {
    case TotalEnd::reached:
      return "reached";
    case TotalEnd::patches:
      return fmt::format("not reached with at most {} patches", most_patches);
    case TotalEnd::memory:
      return "not reached: more patches do not fit into memory";
    case TotalEnd::directions:
      return "not reached: the error of the directions does not become small enough";
    case TotalEnd::thin:
      return "not reached: the patches are too thin to be divided";
    case TotalEnd::canceled:
      return "interrupted";
    case TotalEnd::other:
      break;
  }
  return "not reached: iterations and method alone are off by more";
}

std::vector<PatchId> patches_to_divide(const Scene& scene, const ErrorReport& report, double total,
                                       const std::vector<std::string>& kept) {
  const Surfaces surfaces = find_surfaces(scene, Measured::reflecting, kept);
  struct Candidate {
    double square;  ///< fraction of the squared error of its surface
    PatchId patch;
  };
  std::vector<std::vector<Candidate>> by_surface(report.surfaces.size());
  bool others_are_coarse = false;
  for (const SurfaceCauses& s : report.surfaces) {
    const double allowed = allowed_for_patches(s.errors, total);
    others_are_coarse = others_are_coarse ||
                        (s.errors.patches > allowed && s.divided_alone > 0.95 * s.errors.patches);
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (const std::int32_t s = surfaces.of(i); s != Surfaces::none) {
      const SurfaceCauses& surface = at(report.surfaces, s);
      const double error = at(report.patch_errors, i);
      at(by_surface, s).push_back({error * error * scene.patch(i).area / surface.area, i});
    }
  }
  std::vector<PatchId> chosen;
  for (std::size_t s = 0; s < by_surface.size(); ++s) {
    std::vector<Candidate>& candidates = by_surface[s];
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.square > b.square; });
    double left = 0;
    for (const Candidate& candidate : candidates) {
      left += candidate.square;
    }
    // Where other surfaces send light from patches that are too large, all are divided further.
    const double allowed = allowed_for_patches(report.surfaces[s].errors, total);
    const double square = others_are_coarse ? 0.5 * left : allowed * allowed;
    // At least a tenth is divided, so that stages are few.
    std::size_t least = left > square ? candidates.size() / 10 : 0;
    for (const Candidate& candidate : candidates) {
      if (left <= square && least == 0) {
        break;
      }
      least -= least > 0 ? 1 : 0;
      left -= (1 - left_within) * candidate.square;
      chosen.push_back(candidate.patch);
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

TotalPlan::TotalPlan(SolveRequest request, const TotalGoal& goal)
    : request_(std::move(request)), goal_(goal) {
  if (!(goal.total > 0 && goal.total < 1)) {
    throw InputError(fmt::format("total error: {} is not above 0 and below 1", goal.total));
  }
  request_.options.goal.accuracy = std::max(directions_fraction * goal.total, first_directions);
}

std::vector<std::string> TotalPlan::divisions() const {
  std::vector<std::string> names;
  for (const std::vector<PatchId>& chosen : divisions_) {
    if (!chosen.empty()) {
      names.push_back(division_by_numbers(chosen));
    }
  }
  return names;
}

void TotalPlan::assess(const SolveSession& session, const Cancellation& cancellation,
                       const MeasurementObserver& observer) {
  MeasuredSolve solve = measured_solve(session);
  ErrorReport measured = measure_errors(solve, cancellation, observer);
  const TotalSolve before = outcome_;
  outcome_.report = std::move(measured);
  outcome_.solve = std::move(solve);
  const ErrorReport& report = outcome_.report;
  if (report.worst < 0) {
    return end(TotalEnd::reached);
  }
  const SurfaceCauses& worst = at(report.surfaces, report.worst);
  outcome_.stages.push_back({.patches = request_.scene->patch_count(),
                             .passes = outcome_.solve.options.directions,
                             .surface = worst.name,
                             .errors = worst.errors,
                             .seconds = session.seconds() + report.measurements.seconds});
  divisions_.emplace_back();
  if (report.total() <= goal_.total) {
    return end(TotalEnd::reached);
  }
  if (worst.errors.iterations + worst.errors.method >= goal_.total) {
    return end(TotalEnd::other);
  }
  const bool patches_too_large = std::any_of(
      report.surfaces.begin(), report.surfaces.end(), [&](const SurfaceCauses& surface) {
        return surface.errors.patches > allowed_for_patches(surface.errors, goal_.total) / caution;
      });
  if (!patches_too_large) {
    return ask_more_of_directions(worst.errors);
  }
  try {
    divide_worst(cancellation);
  } catch (const Canceled&) {
    outcome_ = before;
    divisions_.pop_back();
    throw;
  }
}

void TotalPlan::end(TotalEnd why) {
  outcome_.end = why;
  outcome_.solve.solution.complete = why != TotalEnd::canceled;
  outcome_.solve.solution.accuracy.reset();
  finished_ = true;
}

void TotalPlan::cancel() { end(TotalEnd::canceled); }

void TotalPlan::divide_worst(const Cancellation& cancellation) {
  const Scene& scene = *request_.scene;
  std::vector<PatchId> chosen =
      patches_to_divide(scene, outcome_.report, goal_.total, request_.options.goal.surfaces);
  const std::shared_ptr<const Scene> divided = divide(scene, chosen, cancellation).scene;
  if (divided->patch_count() == scene.patch_count()) {
    return end(TotalEnd::thin);
  }
  if (divided->patch_count() > goal_.patches) {
    return end(TotalEnd::patches);
  }
  try {
    check_memory(scene.name(), divided->patch_count(), request_.options.replicas,
                 request_.options.basis == Basis::linear ? 3 : 1);
  } catch (const std::runtime_error&) {
    return end(TotalEnd::memory);
  }
  solve_next(divided);
  divisions_.back() = std::move(chosen);
  double expected = 0;
  for (const SurfaceCauses& surface : outcome_.report.surfaces) {
    expected = std::max(expected, std::sqrt(left_within) * surface.errors.patches);
  }
  request_.options.goal.accuracy =
      std::max(directions_fraction * goal_.total, early_fraction * expected);
}

void TotalPlan::solve_next(const std::shared_ptr<const Scene>& scene) {
  request_.scene = scene;
  request_.tree = nullptr;
  request_.shot = nullptr;
}

void TotalPlan::ask_more_of_directions(const CauseErrors& worst) {
  double& directions = request_.options.goal.accuracy;
  const double others = worst.total() - worst.directions;
  const double asked = std::min(caution * (goal_.total - others), 0.9 * directions);
  const auto& accuracy = outcome_.solve.solution.accuracy;
  if (asked < least_directions_fraction * goal_.total || (accuracy && !accuracy->reached)) {
    return end(TotalEnd::directions);
  }
  directions = asked;
}

template <class Archive, class Self>
void TotalPlan::visit_state(Archive& archive, Self& self) {
  auto& stages = self.outcome_.stages;
  archive(self.request_.options.goal.accuracy, self.divisions_);
  if constexpr (Archive::reading) {
    stages.resize(self.divisions_.size());
  }
  for (auto& stage : stages) {
    std::vector<char> surface(stage.surface.begin(), stage.surface.end());
    archive(stage.patches, stage.passes, surface, stage.errors.directions, stage.errors.patches,
            stage.errors.iterations, stage.errors.method, stage.seconds);
    if constexpr (Archive::reading) {
      stage.surface.assign(surface.begin(), surface.end());
    }
  }
}

void TotalPlan::save(std::ostream& out) const {
  StateOutput archive(out);
  visit_state(archive, *this);
}

void TotalPlan::restore(std::istream& in, std::uint64_t size, const Cancellation& cancellation) {
  StateInput archive(in, size);
  visit_state(archive, *this);
  archive.finish();
  archive.require(request_.options.goal.accuracy > 0 && request_.options.goal.accuracy < 1);
  for (const std::vector<PatchId>& chosen : divisions_) {
    PatchId before = -1;
    for (const PatchId i : chosen) {
      archive.require(before < i && i < request_.scene->patch_count());
      before = i;
    }
    if (!chosen.empty()) {
      solve_next(divide(*request_.scene, chosen, cancellation).scene);
    }
  }
}

}  // namespace transillum
