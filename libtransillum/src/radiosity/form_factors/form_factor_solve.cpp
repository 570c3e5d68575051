// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Jacobi iteration with a given matrix F, for hemicubes, relighting and solve_radiosity().
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/for_each_index.h"
#include "base/seconds_since.h"
#include "radiosity/form_factors/jacobi.h"
#include "radiosity/linear_solution.h"
#include "radiosity/norms.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/relight.h"

namespace transillum {
namespace {

NotConvergent divergence() {
  return {"the iteration does not converge: the row sums of the form factors are too large",
          Remedy::none};
}

void check_start(const Scene& scene, const RelightOptions& options) {
  if ((!options.start.empty() && options.start.size() != scene.patches().size()) ||
      (!options.start_linear_terms.empty() &&
       options.start_linear_terms.size() != options.start.size())) {
    throw InputError(
        "the initial radiosity belongs to another scene: the number of patches differs");
  }
}

/// The unknowns of means and linear terms.
/// @param parts empty: 0
std::vector<Rgb> unknowns_of(std::span<const Rgb> means, std::span<const LinearTerm> parts,
                             std::size_t per_patch) {
  std::vector<Rgb> unknowns;
  for (std::size_t i = 0; i < means.size(); ++i) {
    unknowns.push_back(means[i]);
    if (per_patch > 1) {
      const LinearTerm part = parts.empty() ? LinearTerm() : parts[i];
      unknowns.insert(unknowns.end(), {part.first, part.second});
    }
  }
  return unknowns;
}

}  // namespace

JacobiIteration::JacobiIteration(const Scene& scene, const FormFactors& form_factors,
                                 std::span<const Material> materials, int threads,
                                 std::span<const std::int32_t> patch_materials,
                                 std::size_t per_patch)
    : scene_(scene),
      form_factors_(form_factors),
      materials_(materials),
      patch_materials_(patch_materials),
      per_patch_(per_patch),
      threads_(thread_count(threads)) {
  for (std::size_t u = 0; u < per_patch * scene.patches().size(); ++u) {
    b.push_back(exitance(u));
  }
  h.resize(b.size());
}

const Material& JacobiIteration::material(std::size_t unknown) const {
  const std::size_t patch = unknown / per_patch_;
  return at(materials_,
            patch_materials_.empty() ? scene_.patches()[patch].material : patch_materials_[patch]);
}

Rgb JacobiIteration::exitance(std::size_t unknown) const {
  return unknown % per_patch_ == 0 ? material(unknown).exitance : Rgb{};
}

template <class Visit>
void JacobiIteration::for_each_row(const Cancellation& cancellation, Visit visit) const {
  WorkerThreads workers(threads_);
  for_each_index(workers, std::size_t{0}, b.size(), [&](std::size_t i) {
    cancellation.throw_if_canceled();
    visit(i);
  });
}

Rgb JacobiIteration::gather(std::size_t unknown, const std::vector<Rgb>& values) const {
  const FormFactors& f = form_factors_;
  const std::size_t row = unknown / per_patch_, a = unknown % per_patch_;
  Rgb gathered;
  for (std::size_t k = f.row_begin[row]; k < f.row_begin[row + 1]; ++k) {
    if (per_patch_ == 1) {
      gathered += f.value[k] * at(values, f.source[k]);
      continue;
    }
    const std::size_t first = per_patch_ * static_cast<std::size_t>(f.source[k]);
    for (std::size_t c = 0; c < per_patch_; ++c) {
      gathered += f.moments[k].of(a, c) * values[first + c];
    }
  }
  return gathered;
}

void JacobiIteration::shoot_first(const DirectLight& shot, const Cancellation& cancellation) {
  if (per_patch_ > 1 && shot.linear_terms.empty()) {
    throw InputError("the first shot was made for constant functions: it has no linear parts");
  }
  const std::vector<Rgb> received = unknowns_of(shot.irradiance, shot.linear_terms, per_patch_);
  const std::vector<Rgb> sent = unknowns_of(shot.exitance, {}, per_patch_);
  correction_.resize(b.size());
  for_each_row(cancellation,
               [&](std::size_t u) { correction_[u] = received[u] - gather(u, sent); });
}

void JacobiIteration::add_sky(std::span<const Rgb> irradiance,
                              std::span<const LinearTerm> linear_terms) {
  if (irradiance.empty()) {
    return;
  }
  const std::size_t patches = scene_.patches().size();
  if (irradiance.size() != patches || (per_patch_ > 1 && linear_terms.size() != patches)) {
    throw InputError(
        "the light of the sky belongs to another scene: the number of patches differs");
  }
  correction_.resize(b.size());
  for (std::size_t i = 0; i < patches; ++i) {
    const Rgb& light = irradiance[i];
    if (!is_finite(Vec3{light.r, light.g, light.b}) || std::min({light.r, light.g, light.b}) < 0) {
      throw InputError(
          fmt::format("the light of the sky on patch {} is {} {} {}, not finite and at least 0", i,
                      light.r, light.g, light.b));
    }
  }
  const std::vector<Rgb> received = unknowns_of(irradiance, linear_terms, per_patch_);
  for (std::size_t u = 0; u < received.size(); ++u) {
    correction_[u] += received[u];
  }
}

RemainderBound JacobiIteration::remainder_bound() const {
  std::vector<Rgb> exitances, reflectances;
  std::vector<double> areas;
  for (std::size_t u = 0; u < b.size(); ++u) {
    exitances.push_back(exitance(u));
    reflectances.push_back(material(u).reflectance);
    areas.push_back(scene_.patches()[u / per_patch_].area);
  }
  return {ReflectedLight(std::move(exitances), per_patch_), std::move(areas),
          std::move(reflectances), per_patch_};
}

void JacobiIteration::run(int limit, double tolerance, const Cancellation& cancellation) {
  using Clock = std::chrono::steady_clock;
  const RemainderBound bound = remainder_bound();
  std::vector<Rgb> reflected(b.size()), changes(b.size());
  double last_change = 0, rho_max = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    reflected[i] = b[i] - exitance(i);
    rho_max = std::max(rho_max, max_abs(material(i).reflectance));
  }
  while (!converged && std::ssize(records) < limit) {
    const auto start = Clock::now();
    std::vector<Rgb> next(b.size());
    for_each_row(cancellation, [&](std::size_t i) {
      h[i] = gather(i, b);
      if (!correction_.empty()) {
        h[i] += correction_[i];
      }
      // The difference of B would lose the digits of a small change to a large E.
      const Rgb before = reflected[i];
      reflected[i] = material(i).reflectance * h[i];
      changes[i] = reflected[i] - before;
      next[i] = exitance(i) + reflected[i];
    });
    b.swap(next);
    if (!all_finite(b)) {
      throw divergence();
    }
    const double change = max_norm(changes);
    IterationRecord record;
    record.contraction = records.empty() || last_change == 0 ? 0 : change / last_change;
    bound.describe(record, b, changes, std::max(rho_max, record.contraction));
    record.seconds = seconds_since(start);
    const bool rounded = tolerance > 0 && is_rounding(record);
    records.push_back(record);
    last_change = change;
    converged = rounded || std::max(record.remainder, record.remainder_dimmest) <= tolerance;
  }
}

void JacobiIteration::run_to(double tolerance, const Cancellation& cancellation) {
  run(max_iterations, tolerance, cancellation);
  if (!converged) {
    throw divergence();
  }
}

std::vector<Rgb> solve_radiosity(const Scene& scene, const FormFactors& form_factors,
                                 double tolerance) {
  JacobiIteration iteration(scene, form_factors, scene.materials(), 1);
  iteration.run_to(tolerance, {});
  return std::move(iteration.b);
}

RelightResult relight(const Scene& scene, const FormFactors& form_factors,
                      const std::vector<Material>& materials, const RelightOptions& options,
                      const Cancellation& cancellation) {
  check_form_factor_input(scene, form_factors, materials, options.patch_materials);
  check_start(scene, options);
  const std::size_t per_patch = unknowns_of_patch(form_factors, options.basis);
  JacobiIteration iteration(scene, form_factors, materials, options.threads,
                            options.patch_materials, per_patch);
  if (options.shot && !options.shot->sources.empty()) {
    iteration.shoot_first(with_materials(*options.shot, scene, materials, options.patch_materials),
                          cancellation);
  }
  iteration.add_sky(options.sky_irradiance, options.sky_linear_terms);
  if (!options.start.empty()) {
    iteration.b = unknowns_of(options.start, options.start_linear_terms, per_patch);
  }
  iteration.run_to(options.tolerance, cancellation);
  std::vector<LinearTerm> linear_terms;
  if (per_patch > 1) {
    linear_terms = linear_terms_of(iteration.b);
  }
  return {means_of(std::move(iteration.b), per_patch), means_of(std::move(iteration.h), per_patch),
          static_cast<int>(iteration.records.size()), std::move(iteration.records),
          std::move(linear_terms)};
}

}  // namespace transillum
