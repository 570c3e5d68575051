// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/iteration_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/error_bounds.h"
#include "radiosity/norms.h"
#include "radiosity/ratio.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Fraction of the largest reflected light at which changes may be rounding.
constexpr double rounding = 1e-12;
/// Tolerances of the emitted power beyond which a change of the power refutes convergence.
constexpr double tolerances_of_power = 10;

}  // namespace

IterationHistory::IterationHistory(const SolverInput& input, const RadiosityIterate& first)
    : unknowns_(*input.unknowns),
      options_(input.options),
      remainder_(unknowns_.light(), unknowns_.area, unknowns_.reflectance, unknowns_.per_patch),
      b_(first.b()),
      h_(first.h()),
      mean_(input.options, unknowns_.light()),
      start_(input) {
  set_means();
}

void IterationHistory::set_means() {
  if (unknowns_.per_patch > 1) {
    mean_b_ = unknowns_.means(b_);
    mean_h_ = unknowns_.means(h_);
  }
}

Rgb IterationHistory::with(std::size_t i, const Rgb& value) const {
  return averaged() ? mean_.with(i, value) : value;
}

std::vector<Rgb> IterationHistory::left() const {
  if (semi_iterative()) {
    return averaged() ? mean_.left() : start_.left();
  }
  if (records_.empty()) {
    return {};
  }
  // B_i - E_i = rho_i H_i, and H is off by at most the error of B before the last iteration.
  const Rgb error = distances_to_limit(records_.back().changes, contraction());
  std::vector<Rgb> left(b_.size());
  for (std::size_t u = 0; u < b_.size() && max_abs(error) > 0; ++u) {
    const Rgb& rho = unknowns_.reflectance[u];
    const auto fraction = [](double r, double of) { return r > 0 ? r * of : 0.0; };
    left[u] = {fraction(rho.r, error.r), fraction(rho.g, error.g), fraction(rho.b, error.b)};
  }
  return left;
}

/// The largest reflectance, or the measured factor, which is larger where row sums exceed 1. In
/// other schemes than `fixed` changes have other reasons too.
double IterationHistory::contraction() const {
  const IterationRecord& last = records_.back();
  const bool measured = options_.scheme == Scheme::fixed && last.change > rounding;
  return measured ? std::max(last.contraction, start_.rho_max()) : start_.rho_max();
}

void IterationHistory::update(const RadiosityIterate& iterate, const std::vector<Rgb>& changes,
                              double seconds, bool complete) {
  const double change = max_norm(changes);
  IterationRecord record{.change = remainder_.relative_change(iterate.b(), changes),
                         .seconds = seconds};
  // The first change after reopening comes from the directions, not from an iteration.
  record.contraction = size_since_reopening() == 0 ? 0.0 : ratio_or_zero(change, last_change_);
  last_change_ = change;
  if (semi_iterative()) {
    start_.finish(iterate);
    mean_.add(iterate, b_, start_);
    left_to_do_ = mean_.error(start_);
    // With equal sets the mean converges to B of that one set, and the spread of iterations says
    // nothing about its error.
    record.error = differs_by_iteration(options_.used_sampling()) ? left_to_do_ : std::nullopt;
    record.contraction = records_.empty() ? 0.0 : start_.contraction();
  }
  b_ = averaged() ? mean_.b() : iterate.b();
  h_ = averaged() ? mean_.h() : iterate.h();
  set_means();
  records_.push_back(record);
  if (!all_finite(b_)) {
    throw NotConvergent(
        fmt::format("the iteration does not converge for M = {}: B exceeds the range of numbers",
                    options_.directions),
        Remedy::directions_or_row_normalization);
  }
  remainder_.describe(records_.back(), iterate.b(), changes, contraction());
  if (semi_iterative()) {
    remainder_.describe(records_.back(), b_, left());
  }
  changed_power_ = remainder_.changed_power(changes, sky_irradiance(iterate));
  stop(complete);
}

std::vector<Rgb> IterationHistory::sky_irradiance(const RadiosityIterate& iterate) const {
  std::vector<Rgb> received;
  for (std::size_t u = 0; options_.sky.is_set() && u < b_.size(); u += unknowns_.per_patch) {
    received.push_back(iterate.sky_irradiance(u));
  }
  return received;
}

void IterationHistory::reopen(int directions) {
  options_.directions = directions;
  reopened_at_ = size();
  finished_ = converged_ = false;
}

bool IterationHistory::reached_tolerance() const {
  if (semi_iterative()) {
    return left_to_do_ && *left_to_do_ <= options_.tolerance;
  }
  // Conjugate gradients solve in the second iteration.
  if (traits_of(options_.scheme).is_symmetric && size_since_reopening() < 2) {
    return false;
  }
  const IterationRecord& last = records_.back();
  const bool propagated = std::max(last.remainder, last.remainder_dimmest) <= options_.tolerance;
  return (propagated || is_rounding(last)) &&
         changed_power_ <= tolerances_of_power * options_.tolerance;
}

void IterationHistory::stop(bool complete) {
  const bool reached = complete && reached_tolerance();
  converged_ = reached && (!semi_iterative() || records_.back().error);
  if (options_.iterations > 0) {
    finished_ = size_since_reopening() >= options_.iterations;
  } else if (semi_iterative() && options_.averaged_iterations > 0) {
    finished_ = mean_.count() >= options_.averaged_iterations;
  } else {
    finished_ = reached;
  }
  check_contraction();
}

void IterationHistory::check_contraction() const {
  constexpr std::ptrdiff_t least = 20;
  // The rest of the start decreases irregularly, and after as many iterations at least to 1/e⁴.
  const double patience =
      semi_iterative() ? static_cast<double>(least) + 4 / (1 - start_.rho_max()) : least;
  if (finished_ || size() < patience || records_.back().change <= rounding) {
    return;
  }
  const bool growing = std::all_of(records_.end() - least / 2, records_.end(),
                                   [](const IterationRecord& r) { return r.contraction >= 1; });
  if (growing) {
    throw NotConvergent(
        fmt::format("the iteration does not converge for M = {}: each change is {:.3g} "
                    "times the previous one",
                    options_.directions, records_.back().contraction),
        Remedy::directions_or_row_normalization);
  }
}

}  // namespace transillum
