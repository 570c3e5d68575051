// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/symmetric_scales.h"

#include <algorithm>
#include <cmath>

namespace transillum {
namespace {

/// Largest |d_1, d_2| / d_0: less than 1 for D_i to be positive definite, and so small that the
/// function it multiplies by is not below 0 on triangles, where |phi_1, phi_2| is up to √8.
constexpr double steepest = 0.35;
/// Square of the moments of a row over its sum up to which D_i may correct moments.
constexpr double most_uneven = 0.25;

double square(double x) { return x * x; }

double improve_number(double& scale, double wanted, double sum) {
  scale *= std::sqrt(wanted / sum);
  return std::abs(wanted / sum - 1);
}

}  // namespace

TransferMoments scaled(const TransferMoments& moments, std::span<const double> scales_i,
                       std::span<const double> scales_j) {
  const auto entry = [](std::span<const double> d, std::size_t a, std::size_t b) {
    return a == b ? d[0] : a == 0 ? d[b] : b == 0 ? d[a] : 0.0;
  };
  TransferMoments left, product;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      for (std::size_t c = 0; c < 3; ++c) {
        left.of(a, b) += entry(scales_i, a, c) * moments.of(c, b);
      }
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      for (std::size_t c = 0; c < 3; ++c) {
        product.of(a, b) += left.of(a, c) * entry(scales_j, c, b);
      }
    }
  }
  return product;
}

double improve_scales(std::span<double> scales, std::span<const double> wanted,
                      std::span<const double> image) {
  if (scales.size() == 1) {
    const double sum = scales[0] * image[0];
    return sum > 0 ? improve_number(scales[0], wanted[0], sum) : 0.0;
  }
  double& d = scales[0];
  const double z = image[0], w = wanted[0];
  const double sum = d * z + scales[1] * image[1] + scales[2] * image[2];
  if (!(sum > 0 && w > 0)) {
    return 0;
  }
  const double moments = square(wanted[1]) + square(wanted[2]);
  const double rest = square(z) - square(image[1]) - square(image[2]);
  const double number = (w * z - wanted[1] * image[1] - wanted[2] * image[2]) / rest;
  if (moments > most_uneven * square(w) || !(rest > 0 && number > 0)) {
    scales[1] = scales[2] = 0;
    return d * z > 0 ? improve_number(d, w, d * z) : 0.0;
  }
  // D image = wanted has the solution `number` (1, slope_1, slope_2). Halfway there, as the root
  // of the product is for numbers.
  double worst = std::abs(w / sum - 1);
  double slopes[2];
  for (std::size_t a = 0; a < 2; ++a) {
    const double row = scales[a + 1] * z + d * image[a + 1];
    worst = std::max(worst, std::abs(wanted[a + 1] - row) / w);
    slopes[a] = (scales[a + 1] / d + (wanted[a + 1] / number - image[a + 1]) / z) / 2;
  }
  const double steepness = std::hypot(slopes[0], slopes[1]);
  const double shrink = steepness > steepest ? steepest / steepness : 1.0;
  const double seen = z + shrink * (slopes[0] * image[1] + slopes[1] * image[2]);
  d = std::sqrt(d * w / seen);
  for (std::size_t a = 0; a < 2; ++a) {
    scales[a + 1] = shrink * d * slopes[a];
  }
  return worst;
}

}  // namespace transillum
