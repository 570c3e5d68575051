// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Studies: the error of B against the number of passes, for several series of options. Input: a
// Scene, its BspTree, StudyOptions and a reference solution.
#include "transillum/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/bit_mixing.h"
#include "base/choice.h"
#include "base/power_of_two.h"
#include "radiosity/linear_solution.h"
#include "radiosity/norms.h"
#include "radiosity/reflected_light.h"
#include "transillum/bounds.h"
#include "transillum/errors.h"
#include "transillum/form_factor_solve.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

/// An arbitrary seed that no user is likely to choose, so that a studied solve shares no direction
/// with the reference.
constexpr std::uint64_t reference_rotation = 0xf3a9c51e0b7d2648U;
constexpr double reference_tolerance = 1e-10;

/// CPU time of all threads of this process, s; independent of other load on the machine.
double processor_seconds() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// b - reference where the reflected light of `reference` is measured, and 0 elsewhere.
std::vector<Rgb> measured_difference(const ReflectedLight& light, const std::vector<Rgb>& b,
                                     const std::vector<Rgb>& reference) {
  const std::vector<char> measured = light.measured(reference);
  std::vector<Rgb> off(b.size());
  for (std::size_t u = 0; u < b.size(); ++u) {
    off[u] = measured[u] != 0 ? b[u] - reference[u] : Rgb{};
  }
  return off;
}

/// @param off error of `reflected`
RadiosityError relative_error(const std::vector<Rgb>& off, const std::vector<Rgb>& reflected) {
  const Rgb largest = largest_magnitudes(reflected);
  if (!(max_abs(largest) > 0)) {
    const double ratio = max_norm(off) / max_norm(reflected);
    return {ratio, ratio};
  }
  return {worst_relative_rms(off, reflected),
          largest_ratio(largest_magnitudes(off), channel_units(largest))};
}

/// The text on the command line: `zbuffer:256`, or `fast`.
std::string engine_text(Engine engine, int resolution) {
  return resolution > 0 ? fmt::format("{}:{}", name_of(engine), resolution) : name_of(engine);
}

/// Runs the solves of a study one after the other; measures errors and time, reports progress.
class StudySolves {
 public:
  StudySolves(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree,
              const StudyOptions& options, std::span<const Rgb> reference,
              const StudyObserver& observer, const Cancellation& cancellation)
      : scene_(std::move(scene)),
        tree_(std::move(tree)),
        options_(options),
        reference_(reference.begin(), reference.end()),
        observer_(observer),
        cancellation_(cancellation),
        rho_max_(measure(*scene_, cancellation).rho_max) {
    for (const StudySeries& series : options.series) {
      if (!takes_directions(series.engine)) {
        all_passes_ += scene_->patch_count();
        continue;
      }
      for (const int m : options.directions) {
        all_passes_ += passes_expected(options.solve_options(series, m)) * options.rotations;
      }
    }
    const std::size_t per_patch = reference.size() / scene_->patches().size();
    if (max_norm(reference_) == 0 ||
        max_norm(ReflectedLight(*scene_, per_patch).of(reference_)) == 0) {
      throw InputError(fmt::format("{}: no patch reflects light, so relative errors are undefined",
                                   scene_->name()));
    }
  }

  const std::vector<StudyPoint>& points() const { return points_; }
  /// The next point, unless it is among those `done` before.
  void add_point(std::size_t series, int m, std::span<const StudyPoint> done) {
    if (points_.size() < done.size()) {
      const SolveOptions solve = options_.solve_options(options_.series[series], m);
      skip(done, passes_expected(solve) * options_.rotations);
    } else {
      points_.push_back(point(series, m));
    }
    report(series, m);
  }
  void add_single_solve(std::size_t series, std::span<const StudyPoint> done) {
    if (points_.size() < done.size()) {
      skip(done, scene_->patch_count());
    } else {
      points_.push_back(single_solve(series));
    }
    report(series, static_cast<int>(scene_->patch_count()));
  }

 private:
  void skip(std::span<const StudyPoint> done, double passes) {
    points_.push_back(done[points_.size()]);
    done_passes_ += passes;
    skipped_passes_ += passes;
  }
  /// @param b coefficients, as in a reference
  RadiosityError error_of(const std::vector<Rgb>& b) const {
    return options_.of_functions() ? function_error(*scene_, b, reference_)
                                   : radiosity_error(*scene_, b, reference_);
  }

  StudyPoint point(std::size_t series, int m) {
    const SolveOptions solve = options_.solve_options(options_.series[series], m);
    StudyPoint point;
    point.series = series;
    point.passes = solve.directions;
    try {
      double passes = 0;
      for (int rotation = 0; rotation < options_.rotations; ++rotation) {
        passes += add_solve(point, m, rotation);
      }
      point.passes = std::llround(passes / options_.rotations);
      point.rms_error = std::sqrt(point.rms_error);
      if (!std::isfinite(point.rms_error)) {
        throw NotConvergent("B exceeds the range of numbers", Remedy::directions);
      }
    } catch (const InputError&) {
      throw;
    } catch (const SolveError& error) {
      point.rms_error = point.max_error = std::numeric_limits<double>::quiet_NaN();
      point.failure = error.what();
      point.remedy = error.remedy();
    } catch (const std::runtime_error& error) {
      point.rms_error = point.max_error = std::numeric_limits<double>::quiet_NaN();
      point.failure = error.what();
    }
    point.directions = point.passes * (solve.two_way ? 2 : 1);
    point.bound = homogeneous_error_bound(
        rho_max_, quadrature_error_bound(static_cast<double>(point.passes)));
    return point;
  }

  /// One point for any M and rotation, of an engine without directions.
  StudyPoint single_solve(std::size_t series) {
    const double start = processor_seconds(), before = done_passes_;
    StudyPoint point;
    point.series = series;
    point.passes = scene_->patch_count();
    point.bound = std::numeric_limits<double>::quiet_NaN();
    SolveOptions solve = options_.solve_options(options_.series[series], 1);
    solve.rotation = std::nullopt;
    const Solution solution =
        solve_by_form_factors(scene_, solve, cancellation_, [&](double fraction) {
          done_passes_ = before + fraction * static_cast<double>(point.passes);
          report(series, static_cast<int>(point.passes));
        });
    point.directions = solution.statistics.directions;
    const RadiosityError error =
        error_of(coefficients_of(solution.radiosity, solution.linear_terms));
    point.rms_error = error.rms;
    point.max_error = error.max;
    point.seconds = processor_seconds() - start;
    return point;
  }

  /// Number of passes in all iterations of a solve that keeps its form factors.
  double passes_expected(const SolveOptions& options) const {
    return options.directions * expected_iterations_with_passes(options, rho_max_);
  }

  /// Adds the contribution of one solve to the means in `point`. Returns its number of passes: M,
  /// or in the semi-iterative scheme M times the iterations.
  double add_solve(StudyPoint& point, int m, int rotation) {
    const double start = processor_seconds();
    const auto options = options_.solve_options(options_.series[point.series], m, rotation);
    RadiositySolver solver(scene_, options, {.tree = tree_}, cancellation_);
    const double before = done_passes_, expected = passes_expected(options);
    solver.advance(RadiositySolver::Until::finished, [&](const RadiositySolver& watched) {
      report(point, before, expected, watched);
      return true;
    });
    done_passes_ = before + expected;
    const RadiosityError error =
        error_of(coefficients_of(solver.radiosity(), solver.linear_terms()));
    const double fraction = 1.0 / options_.rotations;
    point.rms_error += fraction * error.rms * error.rms;
    point.max_error = std::max(point.max_error, error.max);
    point.seconds += fraction * (processor_seconds() - start);
    const double iterations =
        traits_of(options.scheme).renews_directions ? solver.progress().iteration : 1;
    return m * iterations;
  }

  void report(const StudyPoint& point, double before, double expected,
              const RadiositySolver& solver) {
    const SolveProgress progress = solver.progress();
    const int m = solver.options().directions;
    const bool renews = traits_of(solver.options().scheme).renews_directions;
    const double in_solve = progress.direction + (renews ? double(progress.iteration) * m : 0.0);
    done_passes_ = std::max(done_passes_, before + std::min(in_solve, expected));
    report(point.series, m);
  }

  void report(std::size_t series, int m) const {
    if (!observer_) {
      return;
    }
    StudyProgress now;
    now.series = series;
    now.directions = m;
    now.fraction = done_passes_ / all_passes_;
    now.points = points_;
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    if (seconds > 0 && done_passes_ > skipped_passes_) {
      now.passes_per_second = (done_passes_ - skipped_passes_) / seconds;
      now.seconds_left = (all_passes_ - done_passes_) / now.passes_per_second;
    }
    observer_(now);
  }

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const BspTree> tree_;
  const StudyOptions& options_;
  std::vector<Rgb> reference_;
  const StudyObserver& observer_;
  Cancellation cancellation_;
  double rho_max_;
  std::vector<StudyPoint> points_;
  double all_passes_ = 0, done_passes_ = 0, skipped_passes_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

RadiosityError radiosity_error(const Scene& scene, const std::vector<Rgb>& b,
                               const std::vector<Rgb>& reference) {
  const ReflectedLight light(scene, b.size() / scene.patches().size());
  return relative_error(measured_difference(light, b, reference), light.of(reference));
}

RadiosityError function_error(const Scene& scene, const std::vector<Rgb>& b,
                              const std::vector<Rgb>& reference) {
  const std::size_t patches = scene.patches().size(), per_patch = b.size() / patches;
  constexpr std::size_t functions = 3;
  const double area = total_area(scene);
  const ReflectedLight light(scene, functions);
  std::vector<Rgb> values(reference.size());
  for (std::size_t u = 0; u < values.size(); ++u) {
    const std::size_t a = u % functions;
    values[u] = a < per_patch ? b[per_patch * (u / functions) + a] : Rgb{};
  }
  std::vector<Rgb> off = measured_difference(light, values, reference),
                   reflected = light.of(reference);
  const double largest = relative_error(off, reflected).max;
  // By Parseval, ∫ B² = A (b_0² + b_1² + b_2²).
  for (std::size_t u = 0; u < values.size(); ++u) {
    const double weight = std::sqrt(scene.patches()[u / functions].area / area);
    off[u] = weight * off[u];
    reflected[u] = weight * reflected[u];
  }
  return {relative_error(off, reflected).rms, largest};
}

namespace {

constexpr std::array error_measures{
    Choice{ErrorMeasure::rms, "rms", "RMS"},
    Choice{ErrorMeasure::max, "max", "Largest"},
};

}  // namespace

template <>
const Choices& choices_of<ErrorMeasure>() {
  return texts_of<error_measures>("error");
}

SolveOptions reference_options(int passes) {
  SolveOptions options;
  options.directions = passes;
  options.sampling = Sampling::fibonacci;
  options.rotation = reference_rotation;
  options.tolerance = reference_tolerance;
  return options;
}

std::vector<std::string> names_of(std::span<const StudySeries> series) {
  std::vector<std::string> names;
  for (const StudySeries& s : series) {
    names.push_back(name_of(s.sampling));
  }
  const auto append_if_different = [&](auto value_of, auto text_of) {
    const auto differs = [&](const StudySeries& s) { return value_of(s) != value_of(series[0]); };
    if (std::none_of(series.begin(), series.end(), differs)) {
      return;
    }
    for (std::size_t k = 0; k < series.size(); ++k) {
      names[k] += "/" + std::string(text_of(value_of(series[k])));
    }
  };
  append_if_different([](const StudySeries& s) { return s.two_way; },
                      [](bool two_way) { return two_way ? "two-way" : "one-way"; });
  append_if_different([](const StudySeries& s) { return s.normalize; },
                      [](Normalization n) { return name_of(n); });
  append_if_different([](const StudySeries& s) { return s.scheme; },
                      [](Scheme s) { return name_of(s); });
  append_if_different([](const StudySeries& s) { return s.basis; },
                      [](Basis basis) { return name_of(basis); });
  append_if_different([](const StudySeries& s) { return std::pair(s.engine, s.resolution); },
                      [](const auto& how) { return engine_text(how.first, how.second); });
  append_if_different([](const StudySeries& s) { return s.first_shot; },
                      [](const std::optional<double>& ratio) {
                        return ratio ? "first-shot " + name_of_first_shot(ratio)
                                     : std::string("no-shot");
                      });
  const bool bases_differ = std::any_of(series.begin(), series.end(), [&](const StudySeries& s) {
    return s.basis != series[0].basis;
  });
  for (std::size_t k = 0; k < series.size(); ++k) {
    // The other options do not affect engines without directions.
    if (!takes_directions(series[k].engine)) {
      names[k] = engine_text(series[k].engine, series[k].resolution);
      names[k] += bases_differ ? "/" + name_of(series[k].basis) : "";
    }
  }
  return names;
}

SolveOptions StudyOptions::solve_options(const StudySeries& of, int passes, int rotation) const {
  SolveOptions options = solve;
  options.directions = passes;
  options.sampling = of.sampling;
  options.two_way = of.two_way;
  options.normalize = of.normalize;
  options.scheme = of.scheme;
  options.first_shot = of.first_shot;
  options.engine = of.engine;
  options.basis = of.basis;
  (traits_of(of.engine).takes_points ? options.engine_options.points
                                     : options.engine_options.resolution) = of.resolution;
  if (traits_of(of.scheme).renews_directions && options.averaged_iterations == 0) {
    options.averaged_iterations = default_averaged_iterations;
  }
  if (rotations > 1) {
    options.seed = mixed(solve.seed + golden_step * static_cast<std::uint64_t>(rotation));
    options.rotation = mixed(options.seed);
  }
  return options;
}

double expected_iterations_with_passes(const SolveOptions& options, double rho_max) {
  if (!traits_of(options.scheme).renews_directions) {
    return 1;
  }
  if (options.iterations > 0) {
    return options.iterations;
  }
  // Until the start counts for a thousandth.
  constexpr double fraction = 1e-3;
  const double burn_in =
      options.burn_in ? *options.burn_in : std::ceil(iterations_to(fraction, rho_max).value_or(0));
  return burn_in + options.averaged_iterations;
}

bool StudyOptions::of_functions() const {
  return std::any_of(series.begin(), series.end(),
                     [](const StudySeries& one) { return one.basis == Basis::linear; });
}

SolveOptions StudyOptions::reference(int passes) const {
  if (passes == 0) {
    const int most = *std::max_element(directions.begin(), directions.end());
    passes = most > max_directions / 4 ? max_directions : 4 * most;
  }
  SolveOptions options = reference_options(passes);
  options.first_shot.reset();
  options.memory = solve.memory;
  options.threads = solve.threads;
  if (of_functions()) {
    options.basis = Basis::linear;
  }
  for (const StudySeries& one : series) {
    if (!one.first_shot) {
      continue;
    }
    options.first_shot = std::min(*one.first_shot, options.first_shot.value_or(*one.first_shot));
  }
  return options;
}

void StudyOptions::validate() const {
  if (series.empty()) {
    throw InputError("study: no series is given");
  }
  if (directions.empty()) {
    throw InputError("study: no number of directions is given");
  }
  if (rotations < 1 || rotations > 1000) {
    throw InputError(fmt::format("rotations: {} is not in the range 1 to 1000", rotations));
  }
  for (const StudySeries& one : series) {
    for (const int m : directions) {
      solve_options(one, m).validate();
    }
    if (!takes_directions(one.engine)) {
      check_form_factor_options(solve_options(one, 1));
    }
  }
}

std::vector<Rgb> solve_reference(const std::shared_ptr<const Scene>& scene,
                                 const std::shared_ptr<const BspTree>& tree,
                                 const SolveOptions& options,
                                 const std::function<void(const SolveProgress&)>& observer,
                                 const Cancellation& cancellation) {
  RadiositySolver solver(scene, options, {.tree = tree}, cancellation);
  solver.advance(RadiositySolver::Until::finished, [&](const RadiositySolver& watched) {
    if (observer) {
      observer(watched.progress());
    }
    return true;
  });
  return coefficients_of(solver.radiosity(), solver.linear_terms());
}

Study run_study(const std::shared_ptr<const Scene>& scene,
                const std::shared_ptr<const BspTree>& tree, const StudyOptions& options,
                const StudyStart& start, const StudyObserver& observer,
                const Cancellation& cancellation) {
  options.validate();
  const std::size_t per_patch = options.of_functions() ? 3 : 1;
  if (start.reference.size() != per_patch * scene->patches().size()) {
    throw InputError(fmt::format("study: the reference has {} patches, the scene {}",
                                 start.reference.size() / per_patch, scene->patch_count()));
  }
  std::vector<int> ascending = options.directions;
  std::sort(ascending.begin(), ascending.end());
  Study study;
  StudySolves run(scene, tree, options, start.reference, observer, cancellation);
  try {
    for (const int m : ascending) {
      for (std::size_t series = 0; series < options.series.size(); ++series) {
        if (takes_directions(options.series[series].engine)) {
          run.add_point(series, m, start.done);
        }
      }
    }
    for (std::size_t series = 0; series < options.series.size(); ++series) {
      if (!takes_directions(options.series[series].engine)) {
        run.add_single_solve(series, start.done);
      }
    }
    study.complete = true;
  } catch (const Canceled&) {
  }
  study.points = run.points();
  std::stable_sort(study.points.begin(), study.points.end(),
                   [](const StudyPoint& a, const StudyPoint& b) { return a.series < b.series; });
  return study;
}

std::vector<StudyPoint> points_of(const Study& study, std::size_t series) {
  std::vector<StudyPoint> points;
  std::copy_if(study.points.begin(), study.points.end(), std::back_inserter(points),
               [series](const StudyPoint& point) { return point.series == series; });
  return points;
}

std::optional<PowerLaw> fitted_power_law(std::span<const StudyPoint> points, ErrorMeasure measure) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const StudyPoint& point : points) {
    const double error = point.error(measure);
    if (!(error > 0 && std::isfinite(error))) {
      continue;
    }
    const double u = std::log(static_cast<double>(point.passes)), v = std::log(error);
    n += 1;
    x += u;
    y += v;
    xx += u * u;
    xy += u * v;
  }
  const double determinant = n * xx - x * x;
  if (n < 2 || !(determinant > 1e-12 * n * xx)) {
    return std::nullopt;
  }
  const double slope = (n * xy - x * y) / determinant;
  return PowerLaw{slope, std::exp((y - slope * x) / n)};
}

std::optional<StudyCost> cost_of(std::span<const StudyPoint> points, double accuracy,
                                 ErrorMeasure measure) {
  // Backward over all points within the accuracy.
  auto first = points.end();
  while (first != points.begin() && (first - 1)->error(measure) <= accuracy) {
    --first;
  }
  if (first == points.end()) {
    return std::nullopt;
  }
  const auto passes = static_cast<double>(first->passes);
  if (first == points.begin() || !std::isfinite((first - 1)->error(measure))) {
    return StudyCost{passes, first->seconds, true};
  }
  const StudyPoint& worse = *(first - 1);
  const double high = worse.error(measure), low = first->error(measure);
  const double t = low > 0 ? std::log(high / accuracy) / std::log(high / low) : 1.0;
  const auto between = [t](double a, double b) { return a * std::pow(b / a, t); };
  return StudyCost{between(static_cast<double>(worse.passes), passes),
                   between(worse.seconds, first->seconds), false};
}

}  // namespace transillum
