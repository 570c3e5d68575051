// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Shapes of lobes.
#include "radiosity/glossy/lobe_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/glossy/lobe_vectors.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

constexpr double largest_whole_exponent = 1 << 20;
constexpr double least_alpha = 1e-4;

double alpha_of(const Lobe& lobe) { return std::max(lobe.roughness * lobe.roughness, least_alpha); }

/// (alpha² / (1 + (alpha² - 1) cos² h))², where cos² h = (cosine_a + cosine_b)² / (2 + 2 a·b), at
/// most 1. One division.
inline double ggx(double sum, double between, double alpha2) {
  const double length2 = std::max(2 + 2 * between, 1e-30);
  const double ratio = alpha2 * length2 / (length2 + (alpha2 - 1) * std::min(sum * sum, length2));
  return ratio * ratio;
}

}  // namespace

double equivalent_exponent(const Lobe& lobe) {
  // The half vector is at the angle t/2 where the mirror direction is at t: GGX falls to a
  // quarter at t/2 = alpha, Phong's lobe about where n t²/2 = ln 4.
  const double alpha = alpha_of(lobe);
  return lobe.shape == LobeShape::phong ? lobe.exponent : std::numbers::ln2 / (alpha * alpha);
}

Hemisphere::Hemisphere(const std::vector<Vec3>& directions, const Vec3& normal) {
  const std::size_t count = directions.size();
  for (std::vector<double>* values : {&x, &y, &z, &cosine}) {
    values->resize(count);
  }
  for (std::size_t q = 0; q < count; ++q) {
    const double c = dot(directions[q], normal);
    const double sign = c < 0 ? -1.0 : 1.0;
    x[q] = sign * directions[q].x;
    y[q] = sign * directions[q].y;
    z[q] = sign * directions[q].z;
    cosine[q] = std::abs(c);
  }
}

LobeKernel::LobeKernel(const Lobe& lobe)
    : shape_(lobe.shape),
      exponent_(lobe.exponent),
      is_whole_(lobe.exponent <= largest_whole_exponent &&
                lobe.exponent == std::floor(lobe.exponent)),
      alpha2_(alpha_of(lobe) * alpha_of(lobe)),
      width_(equivalent_exponent(lobe)) {
  whole_exponent_ = is_whole_ ? static_cast<unsigned>(lobe.exponent) : 0;
  constexpr double log_of_least = -69;
  least_ = exponent_ > 0 ? std::exp(log_of_least / exponent_) : 0.0;
}

double LobeKernel::power(double base) const {
  if (!is_whole_) {
    return std::pow(base, exponent_);
  }
  double value = 1;
  for (unsigned e = whole_exponent_; e > 0; e >>= 1) {
    value = (e & 1) != 0 ? value * base : value;
    base *= base;
  }
  return value;
}

double LobeKernel::value(double cosine_a, double cosine_b, double between) const {
  if (shape_ == LobeShape::phong) {
    const double mirror = 2 * (cosine_a * cosine_b) - between;
    return exponent_ == 0 ? 1.0 : mirror > least_ ? power(mirror) : 0.0;
  }
  return ggx(cosine_a + cosine_b, between, alpha2_);
}

void LobeKernel::row(const Vec3& a, double cosine, const Hemisphere& directions,
                     double* values) const {
  const std::size_t count = directions.size();
  const auto &x = directions.x, &y = directions.y, &z = directions.z, &c = directions.cosine;
  const LobeRow row{x.data(), y.data(), z.data(), c.data(), count, a, cosine, values};
  std::size_t done = 0;
  if (shape_ == LobeShape::ggx) {
    done = ggx_row(row, alpha2_);
  } else if (exponent_ == 0) {
    std::fill(values, values + count, 1.0);
    return;
  } else if (is_whole_) {
    done = phong_row(row, least_, whole_exponent_);
  }
  for (std::size_t q = done; q < count; ++q) {
    values[q] = value(cosine, c[q], a.x * x[q] + a.y * y[q] + a.z * z[q]);
  }
}

}  // namespace transillum
