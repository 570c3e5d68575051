// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What a solver reports: progress, statistics, form factors, error estimate, solution. Input: the
// parts of RadiositySolver::Impl, between passes.
#include <algorithm>
#include <stdexcept>

#include "radiosity/channel_sums.h"
#include "radiosity/error/error_estimate.h"
#include "radiosity/linear_solution.h"
#include "radiosity/ratio.h"
#include "radiosity/reflected_light.h"
#include "radiosity/solver/solver_state.h"
#include "transillum/at.h"
#include "transillum/bounds.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Sets rho_max, predicted_contraction and energy_balance. Requires statistics.directions.
/// @param from_sky irradiance from the sky; empty without one
void add_scene_values(const Scene& scene, const std::vector<Rgb>& h,
                      const std::vector<Rgb>& from_sky, SolveStatistics& statistics) {
  double absorbed = 0, emitted = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const double area = scene.patch(i).area;
    const Rgb& rho = scene.reflectance(i);
    absorbed += area * sum((Rgb{1, 1, 1} - rho) * at(h, i));
    emitted +=
        area * sum(from_sky.empty() ? scene.exitance(i) : scene.exitance(i) + at(from_sky, i));
    statistics.rho_max = std::max(statistics.rho_max, max_abs(rho));
  }
  statistics.energy_balance = ratio_or_zero(absorbed, emitted);
  statistics.predicted_contraction =
      contraction_bound(statistics.rho_max, quadrature_error_bound(statistics.directions));
}

}  // namespace

SolveProgress RadiositySolver::Impl::progress() const {
  SolveProgress progress;
  progress.iteration = history.size();
  progress.direction = passes_done();
  progress.passes = history.finished() ? plan.passes(history.size() - 1) : passes_needed();
  progress.finished = history.finished();
  progress.seconds_transfers = timing.seconds_transfers;
  const int made = passes_done() - iteration.from_kept_sums;
  if (made > 0 && iteration.seconds > 0) {
    progress.passes_per_second = made / iteration.seconds;
    progress.seconds_left = (progress.passes - passes_done()) / progress.passes_per_second;
  }
  if (history.size() > 0) {
    progress.change = history.records().back().change;
  }
  if (passes_done() > 0) {
    progress.last_direction = at(iteration.directions, passes_done() - 1);
  } else if (history.size() > 0) {
    progress.last_direction = at(iteration.directions, plan.passes(history.size() - 1) - 1);
  }
  return progress;
}

SolveStatistics RadiositySolver::Impl::solve_statistics() const {
  SolveStatistics result;
  result.patches = input.scene->patch_count();
  result.fragments = std::ssize(input.tree->fragments());
  result.directions = input.options.directions * input.directions_per_pass();
  result.passes = input.options.directions;
  result.passes_made = timing.passes_made;
  result.threads = input.threads;
  result.kept_form_factors = kept.available();
  result.form_factors = kept.size();
  statistics.write_to(result);
  // Other engines are wrong by more than the number of directions tells.
  if (traits_of(input.options.engine).error != EngineTraits::Error::none) {
    result.shot_disagreement = 0;
    result.shot_disagreement_patch = -1;
  }
  result.iterations = history.size();
  result.burn_in = history.burn_in();
  result.iteration_records = history.records();
  result.converged = history.converged();
  result.energy_defect = iteration.energy_defect;
  add_scene_values(*input.scene, history.patch_h(), sky_irradiance(), result);
  result.shot_sources = std::ssize(input.shot->sources);
  result.shot_power_fraction = input.shot->power_fraction;
  result.integrated_pairs = input.shot->integrated_pairs;
  result.seconds_bsp = input.seconds_bsp;
  result.seconds_first_shot = input.seconds_first_shot;
  result.seconds_transfers = timing.seconds_transfers;
  result.seconds_iterate = timing.seconds_iterate;
  result.seconds_total = result.seconds_bsp + result.seconds_first_shot + result.seconds_transfers +
                         result.seconds_iterate;
  return result;
}

FormFactors RadiositySolver::Impl::form_factors() const {
  if (!kept.requested()) {
    throw std::runtime_error(
        "the semi-iterative scheme keeps no form factors unless they are requested");
  }
  if (history.size() == 0 || iteration.begun || kept_areas().passes == 0) {
    throw std::runtime_error(
        "form factors are available between iterations, after one that kept them");
  }
  if (!kept.available()) {
    throw MemoryLimitExceeded("the form factors exceed the memory limit");
  }
  return kept.form_factors(whole, kept_areas());
}

ErrorEstimate RadiositySolver::Impl::error_estimate() const {
  using Radiosity = Replicas::Radiosity;
  const Radiosity kind = history.averaged() ? Radiosity::mean
                         : iteration.begun  ? Radiosity::running_estimate
                                            : Radiosity::finished_iteration;
  const auto& b = kind == Radiosity::running_estimate ? iteration.estimate : history.b();
  ErrorEstimate error = replicas.error_estimate(*input.scene, b, history.h(), kind);
  if (error.replicas == 0) {
    return error;
  }
  const ErrorSurfaces& surfaces = replicas.surfaces();
  include_bias(error, *input.scene, surfaces, b, history.left());
  include_bias(error, *input.scene, surfaces, b, bias_of_shot(*input.scene, surfaces, *input.shot));
  return error;
}

SolveProgress RadiositySolver::progress() const { return impl_->progress(); }
SolveStatistics RadiositySolver::statistics() const { return impl_->solve_statistics(); }
FormFactors RadiositySolver::form_factors() const { return impl_->form_factors(); }
ErrorEstimate RadiositySolver::error_estimate() const { return impl_->error_estimate(); }

std::vector<double> RadiositySolver::form_factor_sums() const {
  const VisibleAreaSums& areas = impl_->statistics.areas();
  std::vector<double> form_factor_sums(areas.projected.size());
  if (areas.passes == 0) {
    return form_factor_sums;
  }
  const std::size_t per_patch = impl_->input.unknowns->per_patch;
  for (std::size_t i = 0; i < form_factor_sums.size(); ++i) {
    const std::size_t u = per_patch * i;
    form_factor_sums[i] =
        impl_->whole.form_factor_sum(u, areas.rows[u], areas.projected[i], areas.passes);
  }
  return form_factor_sums;
}

std::vector<double> RadiositySolver::sky_fractions() const {
  const VisibleAreaSums& areas = impl_->statistics.areas();
  std::vector<double> fractions(areas.uncovered.size());
  if (areas.passes == 0) {
    return fractions;
  }
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    fractions[i] = impl_->whole.sky_fraction(impl_->input.unknowns->per_patch * i,
                                             areas.uncovered[i], areas.projected[i], areas.passes);
  }
  return fractions;
}

std::vector<Rgb> RadiositySolver::Impl::sky_irradiance() const {
  std::vector<Rgb> received;
  if (input.options.sky.is_set()) {
    for (PatchId i = 0; i < input.scene->patch_count(); ++i) {
      received.push_back(whole.sky_irradiance(input.unknowns->mean_of(i)));
    }
  }
  return received;
}

std::vector<Rgb> RadiositySolver::sky_irradiance() const { return impl_->sky_irradiance(); }

std::vector<LinearTerm> RadiositySolver::sky_linear_terms() const {
  std::vector<LinearTerm> terms;
  if (options().sky.is_set() && options().basis == Basis::linear) {
    for (PatchId i = 0; i < impl_->input.scene->patch_count(); ++i) {
      const std::size_t mean = impl_->input.unknowns->mean_of(i);
      terms.push_back(
          {impl_->whole.sky_irradiance(mean + 1), impl_->whole.sky_irradiance(mean + 2)});
    }
  }
  return terms;
}

std::vector<double> RadiositySolver::back_seen_fractions() const {
  return impl_->statistics.back_seen_fractions();
}

std::vector<LinearTerm> RadiositySolver::linear_terms() const {
  std::vector<LinearTerm> terms;
  if (options().basis == Basis::linear) {
    const std::vector<Rgb>& values =
        impl_->passes_done() > 0 ? impl_->iteration.estimate : impl_->history.b();
    for (std::size_t u = 0; u < values.size(); u += 3) {
      terms.push_back({values[u + 1], values[u + 2]});
    }
  }
  return terms;
}

std::vector<Rgb> reflected_light(const Scene& scene, const std::vector<Rgb>& b) {
  return ReflectedLight(scene, b.size() / std::max<std::size_t>(1, scene.patches().size())).of(b);
}

std::vector<Rgb> corner_radiosity(const Solution& solution, PatchId i) {
  const auto outline = solution.scene->outline(i);
  std::vector<Rgb> corners(outline.size(), at(solution.radiosity, i));
  if (!solution.linear_terms.empty()) {
    const LinearBasis basis = linear_basis(*solution.scene, i);
    const LinearTerm& term = at(solution.linear_terms, i);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const auto [first, second] = basis.at(solution.scene->point(outline[k]));
      corners[k] += first * term.first + second * term.second;
    }
  }
  return corners;
}

Solution RadiositySolver::solution() const {
  Solution solution;
  solution.scene = shared_scene();
  solution.sky = options().sky;
  solution.radiosity = impl_->passes_done() > 0 ? running_estimate() : radiosity();
  solution.irradiance = irradiance();
  if (impl_->statistics.areas().passes > 0) {
    solution.form_factor_sums = form_factor_sums();
    solution.sky_fractions = sky_fractions();
    solution.sky_irradiance = sky_irradiance();
    solution.sky_linear_terms = sky_linear_terms();
  }
  solution.error = error_estimate();
  solution.statistics = statistics();
  solution.linear_terms = linear_terms();
  if (traits_of(options().engine).error != EngineTraits::Error::none &&
      is_all_light_lost(solution)) {
    solution.statistics.converged = false;
  }
  solution.statistics.negative_corners = negative_corners(solution);
  solution.complete = impl_->history.finished();
  return solution;
}

}  // namespace transillum
