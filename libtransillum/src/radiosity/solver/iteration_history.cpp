// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/iteration_history.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "radiosity/ratio.h"
#include "transillum/solve_errors.h"

namespace transillum {
namespace {

double max_norm(const std::vector<Rgb>& b) {
  double largest = 0;
  for (const Rgb& value : b) {
    largest = std::max(largest, max_abs(value));
  }
  return largest;
}

double max_distance(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, max_abs(a[i] - b[i]));
  }
  return largest;
}

}  // namespace

IterationHistory::IterationHistory(const SolveOptions& options, const RadiosityIterate& first)
    : options_(options), b_(first.b()), h_(first.h()) {}

Rgb IterationHistory::with(std::size_t i, const Rgb& value) const {
  if (!averaged()) {
    return value;
  }
  return (1.0 / (mean_b_.count + 1)) * (mean_b_.sum[i] + value);
}

double IterationHistory::update(const RadiosityIterate& iterate, double change) {
  if (semi_iterative()) {
    return update_mean(iterate);
  }
  b_ = iterate.b();
  h_ = iterate.h();
  return change;
}

double IterationHistory::update_mean(const RadiosityIterate& iterate) {
  if (past_burn_in()) {
    mean_b_.add(iterate.b());
    mean_h_.add(iterate.h());
  }
  std::vector<Rgb> next = averaged() ? mean_b_.mean() : iterate.b();
  h_ = averaged() ? mean_h_.mean() : iterate.h();
  const double change = max_distance(next, b_);
  b_ = std::move(next);
  return change;
}

void IterationHistory::record(double change, double seconds, bool complete, double energy_defect) {
  IterationRecord record;
  record.change = ratio_or_zero(change, max_norm(b_));
  record.contraction = records_.empty() ? 0.0 : ratio_or_zero(change, last_change_);
  record.seconds = seconds;
  last_change_ = change;
  energy_defect_ = energy_defect;
  records_.push_back(record);
  const bool in_burn_in = semi_iterative() && !averaged();
  converged_ = complete && record.change <= options_.tolerance && !in_burn_in;
  finished_ = options_.iterations > 0 ? size() >= options_.iterations : converged_;
  check_contraction();
}

void IterationHistory::check_contraction() const {
  constexpr std::ptrdiff_t patience = 20;
  if (finished_ || size() < patience) {
    return;
  }
  const bool growing = std::all_of(records_.end() - patience / 2, records_.end(),
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
