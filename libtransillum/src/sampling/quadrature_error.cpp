// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sampling/discrepancy.h"

namespace transillum {

double quadrature_error(const Vec3& normal, std::span<const DirectionSample> samples,
                        bool two_way) {
  double front = 0, back = 0;
  for (const DirectionSample& s : samples) {
    const double cosine = dot(normal, s.direction);
    front += std::max(cosine, 0.0);
    back += std::max(-cosine, 0.0);
  }
  const double mean = (two_way ? (front + back) / 2 : front) / static_cast<double>(samples.size());
  return std::numbers::pi * (4 * mean - 1);
}

QuadratureErrors summary_of(std::span<const double> errors) {
  QuadratureErrors summary;
  for (const double e : errors) {
    summary.rms += e * e / static_cast<double>(errors.size());
    summary.max = std::max(summary.max, std::abs(e));
  }
  summary.rms = std::sqrt(summary.rms);
  return summary;
}

std::vector<double> quadrature_errors(std::span<const Vec3> normals,
                                      std::span<const DirectionSample> samples, bool two_way,
                                      const Cancellation& cancellation) {
  std::vector<double> errors;
  errors.reserve(normals.size());
  for (const Vec3& n : normals) {
    cancellation.throw_if_canceled();
    errors.push_back(quadrature_error(n, samples, two_way));
  }
  return errors;
}

std::vector<Vec3> spread_normals(int count) {
  std::vector<Vec3> normals;
  for (const auto& s : rotated(make_directions(Sampling::fibonacci, count, 0), 0)) {
    normals.push_back(s.direction);
  }
  for (const double sign : {1.0, -1.0}) {
    normals.insert(normals.end(), {{sign, 0, 0}, {0, sign, 0}, {0, 0, sign}});
  }
  return normals;
}

}  // namespace transillum
