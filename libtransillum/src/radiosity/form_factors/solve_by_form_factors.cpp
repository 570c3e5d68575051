// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves with form factors that are given or come from an engine without directions (hemicubes,
// pairs) and fills in the statistics of a Solution. Input: a Scene and SolveOptions.
#include "transillum/form_factor_solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/seconds_since.h"
#include "base/worker_threads.h"
#include "radiosity/error/surface_errors.h"
#include "radiosity/form_factors/jacobi.h"
#include "radiosity/form_factors/pair_matrix.h"
#include "radiosity/linear_solution.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"
#include "radiosity/reflected_light.h"
#include "radiosity/sun_light.h"
#include "scene/build/two_sided.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/study.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

bool is_by_hemicubes(const SolveOptions& options) {
  return traits_of(options.engine).factors == EngineTraits::Factors::hemicubes;
}

/// Computes the form factors, with their moments if the basis is linear, and sets the values that
/// differ between the engines.
FormFactors compute_form_factors(const Scene& scene, const SolveOptions& options,
                                 const Cancellation& cancellation,
                                 const std::function<void(double)>& progress,
                                 SolveStatistics& statistics) {
  const std::int64_t patches = scene.patch_count();
  if (is_by_hemicubes(options)) {
    const HemicubeOptions hemicubes = hemicube_options(options);
    statistics.hemicubes = patches;
    statistics.directions = 3 * hemicubes.resolution * hemicubes.resolution;
    return hemicube_form_factors(scene, hemicubes, cancellation, progress);
  }
  const PairOptions pairs = pair_options(options);
  statistics.pairs = patches * (patches - 1) / 2;
  statistics.directions = pairs.points;
  IntegratedPairs integrated{0};
  FormFactors form_factors = pair_matrix(scene, pairs, cancellation, progress, integrated);
  statistics.integrated_pairs = integrated;
  return form_factors;
}

/// Sums of the rows over the sources' phi_0: for phi_0 the fraction of what leaves a patch that
/// meets others, for phi_1 and phi_2 what closure makes 0.
std::vector<double> row_sums(const FormFactors& form_factors, std::size_t per_patch) {
  std::vector<double> sums;
  for (std::size_t i = 0; i + 1 < form_factors.row_begin.size(); ++i) {
    for (std::size_t a = 0; a < per_patch; ++a) {
      double sum = 0;
      for (std::size_t k = form_factors.row_begin[i]; k < form_factors.row_begin[i + 1]; ++k) {
        sum += a == 0 ? form_factors.value[k] : form_factors.moments[k].of(a, 0);
      }
      sums.push_back(sum);
    }
  }
  return sums;
}

/// Sets the values that are sums over rows of F: closure, escaped, energy and rho_max.
/// @param sums of row_sums()
void add_power(const Scene& scene, const std::vector<double>& sums,
               const JacobiIteration& iteration, const SunLight& sun, SolveStatistics& statistics) {
  const std::size_t per_patch = sums.size() / std::max<std::size_t>(1, scene.patches().size());
  double area = 0, visible = 0, outside = 0, previous = 0;
  Rgb received, sent, absorbed, emitted;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::size_t row = per_patch * static_cast<std::size_t>(i);
    const double sum = sums[row];
    const double own = scene.patch(i).area;
    area += own;
    visible += own * sum;
    if (are_two_sides(scene, i - 1)) {
      outside += own * std::abs(sum - previous);
    }
    previous = sum;
    statistics.closure_defect_max = std::max(statistics.closure_defect_max, std::abs(1 - sum));
    received += own * iteration.h[row];
    sent += own * sum * iteration.b[row];
    // Power that phi_1 and phi_2 send: by reciprocity, as the means receive it.
    for (std::size_t u = row + 1; u < row + per_patch; ++u) {
      sent += own * sums[u] * iteration.b[u];
      statistics.closure_defect_moments =
          std::max(statistics.closure_defect_moments, std::abs(sums[u]));
    }
    absorbed += own * ((Rgb{1, 1, 1} - scene.reflectance(i)) * iteration.h[row]);
    emitted += own * scene.exitance(i);
    if (!sun.irradiance.empty()) {
      emitted += own * at(sun.irradiance, i);
    }
    statistics.rho_max = std::max(statistics.rho_max, max_abs(scene.reflectance(i)));
  }
  statistics.escaped = area > 0 ? std::max(0.0, 1 - (visible + outside) / area) : 0.0;
  statistics.energy_defect = ratio_or_zero(max_abs(received - sent), max_abs(sent));
  statistics.energy_balance =
      ratio_or_zero(absorbed.r + absorbed.g + absorbed.b, emitted.r + emitted.g + emitted.b);
}

/// The iteration with `form_factors`; sets all but what computing them took.
Solution iterate(std::shared_ptr<const Scene> scene, FormFactors form_factors,
                 const SolveOptions& options, const Cancellation& cancellation) {
  const std::size_t per_patch = unknowns_of_patch(form_factors, options.basis);
  Solution solution;
  SolveStatistics& statistics = solution.statistics;
  const auto start = Clock::now();
  JacobiIteration iteration(*scene, form_factors, scene->materials(), options.threads, {},
                            per_patch);
  const SunLight sun = sun_light(scene, nullptr, options, cancellation);
  iteration.add_sky(sun.irradiance, sun.linear_terms);
  iteration.run(options.iterations > 0 ? options.iterations : JacobiIteration::max_iterations,
                options.iterations > 0 ? 0 : options.tolerance, cancellation);
  statistics.seconds_iterate = seconds_since(start);
  const std::vector<double> sums = row_sums(form_factors, per_patch);
  solution.form_factor_sums = means_of(sums, per_patch);
  for (const double sum : solution.form_factor_sums) {
    solution.sky_fractions.push_back(std::max(0.0, 1 - sum));
  }
  add_power(*scene, sums, iteration, sun, statistics);
  solution.sky = options.sky;
  solution.sky_irradiance = sun.irradiance;
  solution.sky_linear_terms = sun.linear_terms;
  if (per_patch > 1) {
    solution.linear_terms = linear_terms_of(iteration.b);
  }
  statistics.patches = statistics.fragments = scene->patch_count();
  statistics.iterations = static_cast<int>(iteration.records.size());
  statistics.threads = thread_count(options.threads);
  statistics.form_factors = static_cast<std::int64_t>(form_factors.size());
  statistics.kept_form_factors = true;
  statistics.converged = iteration.converged;
  statistics.predicted_contraction = statistics.rho_max;
  statistics.iteration_records = std::move(iteration.records);
  solution.scene = std::move(scene);
  solution.radiosity = means_of(std::move(iteration.b), per_patch);
  solution.irradiance = means_of(std::move(iteration.h), per_patch);
  if (traits_of(options.engine).error != EngineTraits::Error::none && is_all_light_lost(solution)) {
    statistics.converged = false;
  }
  statistics.negative_corners = negative_corners(solution);
  solution.form_factors = std::make_shared<const FormFactors>(std::move(form_factors));
  solution.complete = true;
  return solution;
}

/// @throws InputError where an option needs the directions of passes; `who` has none.
void refuse_directions(const SolveOptions& options, const std::string& who) {
  if (options.scheme != Scheme::fixed || options.normalize != Normalization::none ||
      options.replicas > 1 || options.first_shot.value_or(-1) >= 0) {
    throw InputError(who +
                     " no directions, and therefore no schemes, normalizations, replicas or "
                     "first shot");
  }
  if (options.sky.is_bright()) {
    throw InputError(who + " no directions, and cannot tell the sky from the backs of patches");
  }
}

/// Relative RMS difference of B, of the worst surface or of all together; with linear functions, of
/// all coefficients.
double difference(const Solution& a, const Solution& b, AccuracyOf of) {
  const std::vector<Rgb> first = coefficients_of(a.radiosity, a.linear_terms);
  const std::vector<Rgb> second = coefficients_of(b.radiosity, b.linear_terms);
  if (of == AccuracyOf::rms) {
    return radiosity_error(*a.scene, first, second).rms;
  }
  return surface_differences(find_surfaces(*a.scene, Measured::reflecting),
                             reflected_light(*a.scene, first),
                             ::transillum::difference(first, second))
      .limit;
}

}  // namespace

HemicubeOptions hemicube_options(const SolveOptions& options) {
  HemicubeOptions hemicubes{.memory = options.memory, .threads = options.threads};
  if (options.engine_options.resolution > 0) {
    hemicubes.resolution = options.engine_options.resolution;
  }
  return hemicubes;
}

PairOptions pair_options(const SolveOptions& options) {
  PairOptions pairs{.memory = options.memory, .threads = options.threads, .basis = options.basis};
  if (options.engine_options.points > 0) {
    pairs.points = options.engine_options.points;
  }
  return pairs;
}

void check_form_factor_options(const SolveOptions& options) {
  options.validate();
  if (takes_directions(options.engine)) {
    throw InputError("engine " + name_of(options.engine) + " has directions");
  }
  refuse_directions(options, "engine " + name_of(options.engine) + " has");
  const AccuracyGoal& goal = options.goal;
  const bool of_pairs = goal.of == AccuracyOf::rms || goal.of == AccuracyOf::surfaces;
  if (goal.is_set() && (is_by_hemicubes(options) || !of_pairs || goal.seconds > 0)) {
    throw InputError(
        "accuracy: engine hemicube has none to choose, and engine pairs estimates "
        "only the errors of surfaces and the RMS error, without a time limit");
  }
  if (is_by_hemicubes(options)) {
    hemicube_options(options).validate();
  } else {
    pair_options(options).validate();
  }
}

Solution solve_by_form_factors(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                               const Cancellation& cancellation,
                               const std::function<void(double)>& progress) {
  check_form_factor_options(options);
  const auto start = Clock::now();
  SolveStatistics counted;
  FormFactors form_factors = compute_form_factors(*scene, options, cancellation, progress, counted);
  const double seconds_transfers = seconds_since(start);
  Solution solution = iterate(std::move(scene), std::move(form_factors), options, cancellation);
  SolveStatistics& statistics = solution.statistics;
  statistics.hemicubes = counted.hemicubes;
  statistics.pairs = counted.pairs;
  statistics.integrated_pairs = counted.integrated_pairs;
  statistics.directions = counted.directions;
  statistics.passes = static_cast<int>(statistics.patches);
  statistics.passes_made = statistics.patches;
  statistics.seconds_transfers = seconds_transfers;
  statistics.seconds_total = seconds_since(start);
  return solution;
}

Solution solve_with_form_factors(std::shared_ptr<const Scene> scene, FormFactors form_factors,
                                 const SolveOptions& options, const Cancellation& cancellation) {
  options.validate();
  refuse_directions(options, "given form factors have");
  if (options.goal.is_set()) {
    throw InputError("accuracy: given form factors have none to choose");
  }
  check_form_factor_input(*scene, form_factors, scene->materials(), {});
  const auto start = Clock::now();
  Solution solution = iterate(std::move(scene), std::move(form_factors), options, cancellation);
  solution.statistics.seconds_total = seconds_since(start);
  return solution;
}

PairSolution solve_by_pairs(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                            double accuracy, const Cancellation& cancellation,
                            const std::function<void(int points, double fraction)>& progress) {
  if (!(accuracy > 0 && accuracy < 1)) {
    throw InputError(fmt::format("accuracy: {} is not between 0 and 1", accuracy));
  }
  SolveOptions step = options;
  step.engine = Engine::pairs;
  step.tolerance = std::min(options.tolerance, 0.1 * accuracy);
  int& points = step.engine_options.points;
  points = points > 0 ? points : EngineOptions::default_points / 8;
  const auto solved = [&] {
    return solve_by_form_factors(scene, step, cancellation, [&](double fraction) {
      if (progress) {
        progress(points, fraction);
      }
    });
  };
  PairSolution result{solved(), points, HUGE_VAL, false};
  while (!result.reached && 2 * points <= EngineOptions::largest_points) {
    points *= 2;
    result.solution.form_factors.reset();  // the memory limit allows one matrix
    Solution finer = solved();
    result.error = difference(result.solution, finer, options.goal.of);
    result.solution = std::move(finer);
    result.points = points;
    result.reached = result.error <= accuracy;
  }
  return result;
}

}  // namespace transillum
