// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/error/batch_means.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace transillum {
namespace {

constexpr double mean_confidence = 0.95;

/// Variance of the mean of n values of variance 1 whose correlation is r at distance 1, r² at 2, …
double variance_of_mean(double n, double r) {
  return ((1 + r) / (1 - r) - 2 * r * (1 - std::pow(r, n)) / (n * (1 - r) * (1 - r))) / n;
}

}  // namespace

void BatchMeans::add(const std::vector<Rgb>& values) {
  if (in_last_ == 0) {
    if (sums_.size() == most) {
      join_neighbors();
    }
    sums_.emplace_back(values.size());
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    sums_.back()[i] += values[i];
  }
  in_last_ = (in_last_ + 1) % length_;
}

void BatchMeans::join_neighbors() {
  for (std::size_t k = 0; k < most / 2; ++k) {
    for (std::size_t i = 0; i < sums_[k].size(); ++i) {
      sums_[k][i] = sums_[2 * k][i] + sums_[2 * k + 1][i];
    }
  }
  sums_.resize(most / 2);
  length_ *= 2;
}

std::optional<double> BatchMeans::largest_half_width(double correlation, double unit) const {
  const std::size_t count = complete();
  if (count < fewest) {
    return {};
  }
  const auto m = static_cast<double>(count);
  const double of_batch = variance_of_mean(length_, correlation);
  const double of_all = variance_of_mean(m * length_, correlation);
  // Batches that are not much longer than the correlation differ from each other less than their
  // mean differs from its limit: E[squares / m] = of_batch - of_all.
  const double factor = of_all / (of_batch - of_all);
  if (!(factor > 0) || !std::isfinite(factor)) {
    return {};
  }
  double largest = 0;
  for (std::size_t i = 0; i < sums_.front().size(); ++i) {
    const auto value = [&](std::size_t k) { return (1 / (length_ * unit)) * sums_[k][i]; };
    Rgb mean, squares;
    for (std::size_t k = 0; k < count; ++k) {
      mean += (1 / m) * value(k);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Rgb off = value(k) - mean;
      squares += off * off;
    }
    largest = std::max(largest, max_abs(squares));
  }
  const boost::math::students_t student(m - 1);
  return quantile(student, (1 + mean_confidence) / 2) * std::sqrt(largest / m * factor);
}

}  // namespace transillum
