// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "session/next_steps.h"

#include <algorithm>
#include <cmath>

#include "radiosity/error/surfaces.h"
#include "scene/build/division.h"
#include "session/divisions.h"
#include "transillum/at.h"

namespace transillum {
namespace {

constexpr int more_passes = 4;
constexpr double smaller_tolerance = 0.1;

/// Exponent of the decrease of the error with the number of passes, from the stages of an accuracy.
double exponent_of(const Solution& solution) {
  constexpr double expected = 0.9, least = 0.6, largest = 1.3;
  if (!solution.accuracy || solution.accuracy->stages.size() < 2) {
    return expected;
  }
  const AccuracyStage &first = solution.accuracy->stages.front(),
                      &last = solution.accuracy->stages.back();
  if (last.directions < 2 * first.directions || !(last.error > 0) || !std::isfinite(first.error)) {
    return expected;
  }
  const double ratio = static_cast<double>(last.directions) / first.directions;
  return std::clamp(std::log(first.error / last.error) / std::log(ratio), least, largest);
}

/// Time of a solve, without reading.
double seconds_of(const SolveStatistics& s) {
  return s.seconds_bsp + s.seconds_first_shot + s.seconds_transfers + s.seconds_iterate;
}

}  // namespace

std::vector<NextStep> next_steps(const ErrorReport& report, const MeasuredSolve& solve) {
  if (report.worst < 0) {
    return {};
  }
  const Scene& scene = *solve.solution.scene;
  const SurfaceCauses& worst = at(report.surfaces, report.worst);
  const Surfaces surfaces = find_surfaces(scene, Measured::reflecting, solve.options.goal.surfaces);
  std::int64_t all = 0, alone = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const int more = division_count(scene, i) - 1;
    all += more;
    alone += surfaces.of(i) == report.worst ? more : 0;
  }
  const CauseErrors& errors = worst.errors;
  const double total = errors.total(), now = seconds_of(solve.solution.statistics);
  const NextStep same{.surface = worst.name,
                      .patches = scene.patch_count(),
                      .passes = solve.options.directions,
                      .tolerance = solve.options.tolerance,
                      .seconds = now,
                      .from = total};
  // The measured solve had `measured` patches more.
  const auto measured =
      static_cast<double>(report.measurements.divided_patches - scene.patch_count());
  const double per_patch =
      measured > 0 ? std::max(0.0, report.measurements.divided_seconds - now) / measured : 0;
  std::vector<NextStep> steps(4, same);
  steps[0].kind = NextStep::Kind::divide_surface;
  steps[0].patches += alone;
  steps[0].seconds += per_patch * static_cast<double>(alone);
  steps[0].to = total - errors.patches + worst.divided_alone;
  steps[1].kind = NextStep::Kind::divide_all;
  steps[1].patches += all;
  steps[1].seconds += per_patch * static_cast<double>(all);
  steps[1].to = total - errors.patches + worst.divided_all;
  steps[2].kind = NextStep::Kind::directions;
  steps[2].passes *= more_passes;
  steps[2].seconds *= more_passes;
  steps[2].to =
      total - errors.directions * (1 - std::pow(more_passes, -exponent_of(solve.solution)));
  steps[3].kind = NextStep::Kind::iterations;
  steps[3].tolerance *= smaller_tolerance;
  steps[3].to = total - errors.iterations * (1 - smaller_tolerance);
  constexpr double least_gain = 0.02;  // fraction of the error; less is not worth a solve
  std::erase_if(steps, [&](const NextStep& s) { return !(s.to < (1 - least_gain) * s.from); });
  std::stable_sort(steps.begin(), steps.end(),
                   [](const NextStep& a, const NextStep& b) { return a.gain() > b.gain(); });
  return steps;
}

std::vector<PatchId> divided_patches(const NextStep& step, const MeasuredSolve& solve) {
  const Scene& scene = *solve.solution.scene;
  switch (step.kind) {
    case NextStep::Kind::divide_all:
      return all_patches(scene);
    case NextStep::Kind::divide_surface:
      return patches_of_surface(scene, step.surface, solve.options.goal.surfaces);
    case NextStep::Kind::directions:
    case NextStep::Kind::iterations:
      break;
  }
  return {};
}

std::string name_of_division(const NextStep& step, const MeasuredSolve& solve) {
  const std::vector<PatchId> patches = divided_patches(step, solve);
  const std::string name =
      step.kind == NextStep::Kind::divide_all ? std::string(all_patches_name) : step.surface;
  return patches.empty() ? std::string() : division_name(*solve.solution.scene, name, patches);
}

}  // namespace transillum
