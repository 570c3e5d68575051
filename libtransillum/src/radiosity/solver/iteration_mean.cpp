// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/iteration_mean.h"

#include <algorithm>
#include <cmath>

#include "radiosity/norms.h"

namespace transillum {
namespace {

/// Bounds of what is left of the start when the mean begins: as a fraction of the RMS change of the
/// iteration, and of the tolerance.
constexpr double fraction_of_change = 0.25, fraction_of_tolerance = 0.1;

}  // namespace

Rgb IterationMean::with(std::size_t i, const Rgb& value) const {
  return (1.0 / (count() + 1)) * (b_.sum[i] + value);
}

std::vector<Rgb> IterationMean::left() const { return left_.mean(); }

std::optional<double> IterationMean::error(const StartRemainder& start) const {
  if (count() == 0) {
    return {};
  }
  const double unit = max_norm(light_.of(b()));
  if (!(unit > 0)) {
    return 0.0;
  }
  const auto half_width = batches_.largest_half_width(start.contraction(), unit);
  if (!half_width) {
    return {};
  }
  return *half_width + max_norm(left_.sum) / count() / unit;
}

void IterationMean::add(const RadiosityIterate& iterate, const std::vector<Rgb>& before,
                        const StartRemainder& start) {
  if (past_) {
    b_.add(iterate.b());
    h_.add(iterate.h());
    left_.add(start.left());
    batches_.add(iterate.b());
    return;
  }
  ++burn_in_;
  past_ = !options_.burn_in && start_is_forgotten(iterate, before, start);
  check_burn_in();
}

void IterationMean::check_burn_in() {
  if (options_.burn_in) {
    past_ = burn_in_ >= *options_.burn_in;
  } else if (options_.iterations > 0 && burn_in_ >= options_.iterations / 2) {
    past_ = true;
  }
}

bool IterationMean::start_is_forgotten(const RadiosityIterate& iterate,
                                       const std::vector<Rgb>& before,
                                       const StartRemainder& start) const {
  const double unit = max_norm(light_.of(iterate.b()));
  if (max_norm(start.left()) <= fraction_of_tolerance * options_.tolerance * unit) {
    return true;
  }
  const std::vector<Rgb> change = difference(iterate.b(), before);
  return root_of_squares(start.left(), unit) <= fraction_of_change * root_of_squares(change, unit);
}

}  // namespace transillum
