// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Measures the errors of a solve by surface and cause. Input: a finished solve; output: an
// ErrorReport. Directions: the spread of replicas. Patches: a solve of the same directions in which
// every patch is divided, so that the errors of directions cancel. Iterations: what changes and
// their contraction leave. Method: another engine, the first shot's own estimate, lost area.
#include "session/measure_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "base/seconds_since.h"
#include "radiosity/channel_sums.h"
#include "radiosity/error/error_estimate.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"
#include "radiosity/reflected_light.h"
#include "radiosity/solver/solver_input.h"
#include "scene/build/division.h"
#include "scene/build/patch_count.h"
#include "session/method_errors.h"
#include "session/next_steps.h"
#include "session/patch_errors.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int added_replicas = 4;
constexpr int most_directions_per_replica = 1 << 22;
/// Least fraction of the patches to divide.
constexpr double least_fraction = 1e-3;

class Measuring {
 public:
  Measuring(const MeasuredSolve& solve, const Cancellation& cancellation,
            const MeasurementObserver& observer)
      : solve_(solve),
        cancellation_(cancellation),
        observer_(observer),
        scene_(*solve.solution.scene),
        surfaces_(scene_, solve.options.goal.surfaces) {}

  ErrorReport run(std::int64_t most_patches) {
    const auto start = Clock::now();
    measure_directions();
    measure_iterations();
    measure_method();
    measure_patches(most_patches);
    add_up();
    report_.steps = next_steps(report_, solve_);
    report_.measurements.seconds = seconds_since(start);
    return std::move(report_);
  }

 private:
  void measure_directions();
  void measure_iterations();
  void measure_method();
  void measure_patches(std::int64_t most_patches);
  std::vector<Rgb> noise_of_division(const SurfaceErrors& fine) const;
  void sum_patches(const PatchErrors& squares, const std::vector<PatchId>& chosen,
                   const std::vector<Rgb>& noise);
  void add_up();

  void observe(Measurement what, double fraction) const {
    if (observer_) {
      observer_(what, fraction);
    }
  }
  std::vector<PatchId> patches_to_divide(std::int64_t most_patches);
  double finished_fraction(const SolveSession& session) const;
  /// Solves with other options or another scene.
  Solution solve_again(SolveOptions options, const std::shared_ptr<const Scene>& scene,
                       const std::shared_ptr<const DirectLight>& shot, Measurement what) const;
  std::shared_ptr<const DirectLight> shot_of(const DividedScene& divided) const;
  /// RMS of a quantity by surface, over the unit of each, of the channel where it is largest; 0
  /// without values.
  std::vector<double> relative(const std::vector<Rgb>& values) const;

  const MeasuredSolve& solve_;
  const Cancellation& cancellation_;
  const MeasurementObserver& observer_;
  const Scene& scene_;
  const ErrorSurfaces surfaces_;
  std::vector<Rgb> standard_error_;  ///< standard error of B, W/m², one per patch
  ErrorReport report_;
};

/// The solve itself took about as many iterations. They are short unless each makes all
/// passes again.
double Measuring::finished_fraction(const SolveSession& session) const {
  const SolveProgress progress = session.progress();
  const double of_passes =
      ratio_or_zero(static_cast<double>(progress.direction), static_cast<double>(progress.passes));
  const double expected = std::max(1, solve_.solution.statistics.iterations);
  if (!session.statistics().kept_form_factors) {
    return std::min(1.0, (progress.iteration + of_passes) / expected);
  }
  constexpr double of_first = 0.9;
  return progress.iteration == 0
             ? of_first * of_passes
             : of_first + (1 - of_first) * std::min(1.0, progress.iteration / expected);
}

Solution Measuring::solve_again(SolveOptions options, const std::shared_ptr<const Scene>& scene,
                                const std::shared_ptr<const DirectLight>& shot,
                                Measurement what) const {
  options.goal = {};
  if (!shot) {
    options.first_shot.reset();
  }
  SolveSession session({.scene = scene,
                        .options = options,
                        .tree = scene == solve_.solution.scene ? solve_.tree : nullptr,
                        .shot = shot},
                       cancellation_);
  session.advance(SolveSession::Until::finished, [&](const SolveSession& watched) {
    observe(what, finished_fraction(watched));
    return true;
  });
  return session.solution();
}

void Measuring::measure_directions() {
  ErrorEstimate error = solve_.solution.error;
  double factor = 1;
  if (error.replicas == 0) {
    SolveOptions options = solve_.options;
    options.replicas = added_replicas;
    options.directions = added_replicas * std::min(options.directions, most_directions_per_replica);
    const int per_replica = options.directions / added_replicas;
    error = solve_again(options, solve_.solution.scene, solve_.shot, Measurement::replicas).error;
    // The error of the mean of four sets is half of the error of one.
    factor = std::sqrt(added_replicas) * per_replica / solve_.options.directions;
    report_.measurements.replicas_added = true;
  }
  report_.measurements.replicas = error.replicas;
  for (const SurfaceError& surface : error.surfaces.surfaces) {
    SurfaceCauses causes{.name = surface.name,
                         .patches = surface.patches,
                         .area = surface.area,
                         .unit = surface.unit,
                         .is_dark = surface.is_dark};
    const double limit = surface.limit * surface.limit - surface.bias * surface.bias;
    causes.errors.directions = factor * std::sqrt(std::max(0.0, limit));
    report_.surfaces.push_back(causes);
  }
  for (const Rgb& of_patch : error.standard_error) {
    standard_error_.push_back(factor * of_patch);
  }
}

std::vector<double> Measuring::relative(const std::vector<Rgb>& values) const {
  const std::vector<Rgb> rms = rms_by_surface(surfaces_.reflecting, values);
  std::vector<double> result;
  for (std::size_t s = 0; s < report_.surfaces.size(); ++s) {
    result.push_back(largest_ratio(rms[s], report_.surfaces[s].unit));
  }
  return result;
}

void Measuring::measure_iterations() {
  const std::vector<double> errors =
      relative(bias_of_iteration(surfaces_, solve_.solution.statistics));
  for (std::size_t s = 0; s < errors.size(); ++s) {
    report_.surfaces[s].errors.iterations = errors[s];
  }
}

void Measuring::measure_method() {
  observe(Measurement::engines, 0);
  const MethodErrors method = method_errors(solve_, surfaces_.reflecting, cancellation_);
  const std::vector<double> shot =
      relative(solve_.shot ? bias_of_shot(scene_, surfaces_, *solve_.shot) : std::vector<Rgb>());
  for (std::size_t s = 0; s < report_.surfaces.size(); ++s) {
    SurfaceCauses& surface = report_.surfaces[s];
    const double engine = largest_ratio(at(method.rms, s), surface.unit);
    surface.errors.method = std::max(engine, method.lost.value_or(0)) + shot[s];
  }
  ErrorMeasurements& measurements = report_.measurements;
  measurements.compared_directions = method.directions;
  measurements.reference = method.reference;
  measurements.lost = method.lost;
  measurements.exact_queries = solve_.solution.statistics.counts.exact_queries;
}

/// All patches, or where these are too many, of each surface a fraction spread evenly over it.
std::vector<PatchId> Measuring::patches_to_divide(std::int64_t most_patches) {
  const auto count = static_cast<double>(scene_.patch_count());
  double fraction = std::min(1.0, (static_cast<double>(most_patches) - count) / (3 * count));
  const int unknowns = solve_.options.basis == Basis::linear ? 3 : 1;
  while (fraction >= least_fraction) {
    try {
      check_memory(scene_.name(), static_cast<std::int64_t>(count * (1 + 3 * fraction)),
                   solve_.options.replicas, unknowns);
      break;
    } catch (const std::runtime_error&) {
      if (fraction < 2 * least_fraction) {
        throw;
      }
      fraction /= 2;
    }
  }
  if (fraction < least_fraction) {
    throw InputError(fmt::format("errors: {} patches leave no room to divide some; at most {}",
                                 scene_.patch_count(), most_patches));
  }
  report_.measurements.divided_fraction = fraction;
  std::vector<double> filled(surfaces_.reflecting.surfaces.size(), 0.5);
  std::vector<PatchId> chosen;
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    bool is_chosen = fraction == 1;
    if (const std::int32_t s = surfaces_.reflecting.of(i); !is_chosen && s != Surfaces::none) {
      at(filled, s) += fraction;
      is_chosen = at(filled, s) >= 1;
      at(filled, s) -= is_chosen ? 1 : 0;
    }
    if (is_chosen) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

/// The first shot of the parts of the same sources.
std::shared_ptr<const DirectLight> Measuring::shot_of(const DividedScene& divided) const {
  if (!solve_.shot) {
    return nullptr;
  }
  std::vector<char> is_source(scene_.patches().size());
  for (const PatchId source : solve_.shot->sources) {
    at(is_source, source) = 1;
  }
  std::vector<PatchId> sources;
  for (PatchId k = 0; k < divided.scene->patch_count(); ++k) {
    if (at(is_source, at(divided.parent, k)) != 0) {
      sources.push_back(k);
    }
  }
  DirectLight shot = shoot(*divided.scene, sources, shot_options(solve_.options), cancellation_);
  if (!solve_.shot->points.empty()) {
    std::vector<int> points;
    for (const PatchId parent : divided.parent) {
      points.push_back(at(solve_.shot->points, parent));
    }
    shot = refined_shot(*divided.scene, solve_.options, shot, points, cancellation_);
  }
  return std::make_shared<const DirectLight>(std::move(shot));
}

void Measuring::measure_patches(std::int64_t most_patches) {
  const std::vector<PatchId> chosen = patches_to_divide(most_patches);
  const auto start = Clock::now();
  const DividedScene divided = divide(scene_, chosen, cancellation_);
  const Solution fine =
      solve_again(solve_.options, divided.scene, shot_of(divided), Measurement::divided);
  const PatchErrors squares = patch_errors(scene_, divided, fine, &solve_.solution);
  report_.measurements.divided_patches = divided.scene->patch_count();
  report_.measurements.divided_seconds = seconds_since(start);
  sum_patches(squares, chosen, noise_of_division(fine.error.surfaces));
}

/// Mean square of what the parts of patches differ by because of the directions alone: their
/// replicas vary more than replicas of the whole patches.
std::vector<Rgb> Measuring::noise_of_division(const SurfaceErrors& fine) const {
  const SurfaceErrors& whole = solve_.solution.error.surfaces;
  std::vector<Rgb> noise(report_.surfaces.size());
  const bool known = report_.measurements.divided_fraction == 1 &&
                     fine.surfaces.size() == noise.size() && whole.surfaces.size() == noise.size();
  for (std::size_t s = 0; known && s < noise.size(); ++s) {
    const Rgb parts = fine.surfaces[s].spreads * fine.surfaces[s].unit;
    const Rgb wholes = whole.surfaces[s].spreads * whole.surfaces[s].unit;
    noise[s] = largest_of({}, parts * parts - wholes * wholes);
  }
  return noise;
}

void Measuring::sum_patches(const PatchErrors& squares, const std::vector<PatchId>& chosen,
                            const std::vector<Rgb>& noise) {
  struct Sums {
    double area = 0;
    Rgb within, shifted;
  };
  std::vector<Sums> sums(surfaces_.reflecting.surfaces.size());
  report_.patch_errors.assign(scene_.patches().size(), 0);
  for (const PatchId i : chosen) {
    const Rgb &within = at(squares.unrepresented, i), &shifted = at(squares.displaced, i);
    const double area = scene_.patch(i).area;
    if (const std::int32_t s = surfaces_.reflecting.of(i); s != Surfaces::none) {
      const Rgb& unit = at(report_.surfaces, s).unit;
      at(report_.patch_errors, i) = std::sqrt(
          largest_ratio((1 / area) * (within_error * within + shift_error * shifted), unit * unit));
      at(sums, s).area += area;
      at(sums, s).within += within;
      at(sums, s).shifted += shifted;
    }
  }
  for (std::size_t s = 0; s < sums.size(); ++s) {
    SurfaceCauses& surface = report_.surfaces[s];
    const double per_area = ratio_or_zero(1, sums[s].area);
    const Rgb within = largest_of({}, per_area * sums[s].within - noise[s]);
    const Rgb shifted = per_area * sums[s].shifted;
    const auto error = [&](double within_factor, double shift_factor) {
      return std::sqrt(largest_ratio(within_factor * within + shift_factor * shifted,
                                     surface.unit * surface.unit));
    };
    surface.errors.patches = error(within_error, shift_error);
    surface.divided_alone = error(left_within * within_error, shift_error);
    surface.divided_all = error(left_within * within_error, left_shift * shift_error);
  }
  // The surface's mean square is the best guess for patches that were not divided.
  for (PatchId i = 0; report_.measurements.divided_fraction < 1 && i < scene_.patch_count(); ++i) {
    const std::int32_t s = surfaces_.reflecting.of(i);
    if (s != Surfaces::none && !std::binary_search(chosen.begin(), chosen.end(), i)) {
      const SurfaceCauses& surface = at(report_.surfaces, s);
      at(report_.patch_errors, i) = surface.errors.patches;
    }
  }
}

void Measuring::add_up() {
  for (std::size_t s = 0; s < report_.surfaces.size(); ++s) {
    if (report_.worst < 0 ||
        report_.surfaces[s].errors.total() > at(report_.surfaces, report_.worst).errors.total()) {
      report_.worst = static_cast<int>(s);
    }
  }
  for (PatchId i = 0; i < scene_.patch_count(); ++i) {
    const std::int32_t s = surfaces_.reflecting.of(i);
    report_.relative_errors.push_back(
        s == Surfaces::none
            ? 0
            : at(report_.patch_errors, i) +
                  largest_ratio(at(standard_error_, i), at(report_.surfaces, s).unit));
  }
}

}  // namespace

void check_measurable(const SolveOptions& options, bool lobes_take_part) {
  if (lobes_take_part) {
    throw InputError("errors by cause: not available with lobes (glossy)");
  }
  if (traits_of(options.scheme).renews_directions) {
    throw InputError(fmt::format(
        "errors by cause: not available with the scheme {}, which renews its directions",
        name_of(options.scheme)));
  }
}

MeasuredSolve measured_solve(const SolveSession& session) {
  check_measurable(session.options(), session.glossy() != nullptr);
  MeasuredSolve solve;
  solve.solution = session.solution();
  solve.options = session.options();
  solve.options.directions = std::max(1, solve.solution.statistics.passes);
  solve.options.replicas = std::max(1, solve.solution.error.replicas);
  solve.tree = session.tree();
  solve.directions = session.directions();
  if (const auto shot = session.diffuse()->direct_light(); shot && !shot->sources.empty()) {
    solve.shot = shot;
  }
  return solve;
}

ErrorReport measure_errors(const MeasuredSolve& solve, const Cancellation& cancellation,
                           const MeasurementObserver& observer, std::int64_t most_patches) {
  return Measuring(solve, cancellation, observer).run(most_patches);
}

}  // namespace transillum
