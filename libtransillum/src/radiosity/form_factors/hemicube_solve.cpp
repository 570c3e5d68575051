// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solves with form factors by hemicubes and fills in the statistics of a Solution.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/seconds_since.h"
#include "base/worker_threads.h"
#include "radiosity/form_factors/jacobi.h"
#include "radiosity/ratio.h"
#include "radiosity/two_sided.h"
#include "transillum/errors.h"
#include "transillum/hemicube.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

HemicubeOptions hemicube_options(const SolveOptions& options) {
  options.validate();
  if (options.scheme != Scheme::fixed || options.normalize != Normalization::none ||
      options.replicas > 1 || options.first_shot || options.goal.set()) {
    throw InputError(
        "engine hemicube has no directions, and therefore no schemes, normalizations, replicas, "
        "first shot or accuracy");
  }
  HemicubeOptions hemicubes;
  if (options.engine_options.resolution > 0) {
    hemicubes.resolution = options.engine_options.resolution;
  }
  hemicubes.memory = options.memory;
  hemicubes.threads = options.threads;
  hemicubes.validate();
  return hemicubes;
}

/// Sets the figures that are sums over rows of F: closure, escaped, energy and rho_max.
void add_power(const Scene& scene, const FormFactors& form_factors,
               const JacobiIteration& iteration, SolveStatistics& statistics) {
  double area = 0, visible = 0, outside = 0, previous = 0;
  Rgb received, sent, absorbed, emitted;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    double sum = 0;
    for (std::size_t k = form_factors.row_begin[row]; k < form_factors.row_begin[row + 1]; ++k) {
      sum += form_factors.value[k];
    }
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
    absorbed += own * ((Rgb{1, 1, 1} - scene.reflectance(i)) * iteration.h[row]);
    emitted += own * scene.exitance(i);
    statistics.rho_max = std::max(statistics.rho_max, max_abs(scene.reflectance(i)));
  }
  statistics.escaped = area > 0 ? std::max(0.0, 1 - (visible + outside) / area) : 0.0;
  statistics.energy_defect = ratio_or_zero(max_abs(received - sent), max_abs(sent));
  statistics.energy_balance =
      ratio_or_zero(absorbed.r + absorbed.g + absorbed.b, emitted.r + emitted.g + emitted.b);
}

}  // namespace

void check_hemicube_options(const SolveOptions& options) { hemicube_options(options); }

Solution solve_by_hemicubes(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                            const Cancellation& cancellation,
                            const std::function<void(double)>& progress) {
  const HemicubeOptions hemicubes = hemicube_options(options);
  const auto start = Clock::now();
  const FormFactors form_factors = hemicube_form_factors(*scene, hemicubes, cancellation, progress);
  Solution solution;
  SolveStatistics& statistics = solution.statistics;
  statistics.seconds_transfers = seconds_since(start);
  const auto start_iteration = Clock::now();
  JacobiIteration iteration(*scene, form_factors, scene->materials(), options.threads);
  iteration.run(options.iterations > 0 ? options.iterations : JacobiIteration::max_iterations,
                options.iterations > 0 ? 0 : options.tolerance, cancellation);
  statistics.seconds_iterate = seconds_since(start_iteration);
  add_power(*scene, form_factors, iteration, statistics);
  statistics.patches = statistics.fragments = scene->patch_count();
  statistics.directions = 3 * hemicubes.resolution * hemicubes.resolution;
  statistics.passes = scene->patch_count();
  statistics.passes_made = statistics.hemicubes = scene->patch_count();
  statistics.iterations = static_cast<int>(iteration.records.size());
  statistics.threads = thread_count(hemicubes.threads);
  statistics.form_factors = static_cast<std::int64_t>(form_factors.size());
  statistics.kept_form_factors = true;
  statistics.converged = iteration.converged;
  statistics.predicted_contraction = statistics.rho_max;
  statistics.iteration_records = std::move(iteration.records);
  statistics.seconds_total = seconds_since(start);
  solution.scene = std::move(scene);
  solution.radiosity = std::move(iteration.b);
  solution.irradiance = std::move(iteration.h);
  solution.complete = true;
  return solution;
}

}  // namespace transillum
