// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Points of the unit square for the samples of a picture.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

namespace transillum {

inline double fraction(double x) { return x - std::floor(x); }

/// phi_2(k): the bits of k mirrored at the radix point.
inline double mirrored_bits(std::uint32_t k) {
  double value = 0;
  for (double digit = 0.5; k != 0; k >>= 1, digit /= 2) {
    value += (k & 1U) != 0 ? digit : 0;
  }
  return value;
}

/// Mixed bits as a number in [0,1).
inline double unit_fraction(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Powers of the plastic number's inverse: their multiples fill the square evenly.
inline constexpr double plastic_step = 0.7548776662466927, plastic_square = 0.5698402909980532;

/// The place of sample k of `count` in a pixel, in [0,1)²: Hammersley's points, with their mean in
/// the middle; the first is near it.
inline std::pair<double, double> sample_place(int k, int count) {
  const int m = (k + count / 2) % count;
  const double half = 0.5 / count;
  return {static_cast<double>(m) / count + half,
          fraction(mirrored_bits(static_cast<std::uint32_t>(m)) + half)};
}

}  // namespace transillum
