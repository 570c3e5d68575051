// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Points of the unit square for the samples of a picture.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "base/bit_mixing.h"

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

/// The parts of a number for SurfaceLight::radiance(): mixed bits of the pixel, and the number of a
/// sample below them.
struct Salt {
  static constexpr unsigned number_bits = 12;  ///< PictureOptions::most_samples is 2^12

  std::uint64_t pixel;
  std::uint32_t number;
};
inline std::uint64_t joined(const Salt& salt) {
  return salt.pixel << Salt::number_bits | salt.number;
}
inline Salt split(std::uint64_t bits) {
  return {bits >> Salt::number_bits,
          static_cast<std::uint32_t>(bits & ((1U << Salt::number_bits) - 1))};
}

inline std::uint32_t reversed(std::uint32_t bits) {
  bits = (bits >> 16) | (bits << 16);
  bits = (bits & 0xff00ff00U) >> 8 | (bits & 0x00ff00ffU) << 8;
  bits = (bits & 0xf0f0f0f0U) >> 4 | (bits & 0x0f0f0f0fU) << 4;
  bits = (bits & 0xccccccccU) >> 2 | (bits & 0x33333333U) << 2;
  return (bits & 0xaaaaaaaaU) >> 1 | (bits & 0x55555555U) << 1;
}

/// Owen's scrambling by a hash of Laine and Karras, with the constants of N. Vegdahl (2021); of
/// numbers whose bits are reversed.
inline std::uint32_t scrambled_reversed(std::uint32_t bits, std::uint32_t seed) {
  bits ^= bits * 0x3d20adeaU;
  bits += seed;
  bits *= (seed >> 16) | 1U;
  bits ^= bits * 0x05526c56U;
  return bits ^ bits * 0x53a22864U;
}

/// Point k of Sobol's sequence in the plane, scrambled: any 2^n consecutive ones from a multiple of
/// 2^n fill the square evenly.
inline std::pair<double, double> scrambled_point(std::uint32_t k, std::uint64_t seed) {
  std::uint32_t second = 0;
  for (std::uint32_t column = 1U << 31, bits = k; bits != 0; bits >>= 1, column ^= column >> 1) {
    second ^= (bits & 1U) != 0 ? column : 0;
  }
  const std::uint64_t seeds = mixed(seed + golden_step);
  const auto number = [](std::uint32_t bits_reversed, std::uint64_t own) {
    return 0x1p-32 * reversed(scrambled_reversed(bits_reversed, static_cast<std::uint32_t>(own)));
  };
  return {number(k, seeds), number(reversed(second), seeds >> 32)};
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
