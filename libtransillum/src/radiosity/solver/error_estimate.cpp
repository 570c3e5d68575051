// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/error_estimate.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "transillum/at.h"

namespace transillum {
namespace {

constexpr double confidence = 0.95;

/// Mean of independent values and its standard error.
struct Mean {
  Rgb value, standard_error;
};

template <class ValueOf>
Mean mean_of(std::size_t count, ValueOf value_of) {
  const auto n = static_cast<double>(count);
  Mean mean;
  for (std::size_t r = 0; r < count; ++r) {
    mean.value += (1 / n) * value_of(r);
  }
  Rgb squares;
  for (std::size_t r = 0; r < count; ++r) {
    const Rgb off = value_of(r) - mean.value;
    squares += off * off;
  }
  const double share = 1 / (n * (n - 1));
  mean.standard_error = {std::sqrt(share * squares.r), std::sqrt(share * squares.g),
                         std::sqrt(share * squares.b)};
  return mean;
}

double sum_of_squares(const Rgb& v) { return v.r * v.r + v.g * v.g + v.b * v.b; }

Rgb mean_over_area(const Scene& scene, const std::vector<Rgb>& b) {
  Rgb power;
  double area = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    power += scene.patch(i).area * at(b, i);
    area += scene.patch(i).area;
  }
  return (1 / area) * power;
}

}  // namespace

ErrorEstimate estimate_error(const Scene& scene, const std::vector<Rgb>& b,
                             const std::vector<std::vector<Rgb>>& replicas) {
  ErrorEstimate error;
  error.replicas = static_cast<int>(replicas.size());
  const boost::math::students_t student(error.replicas - 1);
  error.quantile = quantile(student, (1 + confidence) / 2);
  error.standard_error.reserve(b.size());
  double errors = 0, values = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto patch = static_cast<std::size_t>(i);
    const Mean mean = mean_of(replicas.size(), [&](std::size_t r) { return replicas[r][patch]; });
    error.standard_error.push_back(mean.standard_error);
    errors += sum_of_squares(mean.standard_error);
    values += sum_of_squares(b[patch]);
  }
  error.rms = values > 0 ? std::sqrt(errors / values) : 0.0;
  std::vector<Rgb> means;
  for (const auto& replica : replicas) {
    means.push_back(mean_over_area(scene, replica));
  }
  error.mean_radiosity = mean_over_area(scene, b);
  error.mean_standard_error =
      mean_of(means.size(), [&](std::size_t r) { return means[r]; }).standard_error;
  return error;
}

}  // namespace transillum
