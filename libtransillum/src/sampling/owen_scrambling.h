// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

#include "base/bit_mixing.h"

namespace transillum {

/// Owen's nested uniform scrambling in base 2: each binary digit of x is flipped or not by a random
/// bit that depends on all digits before it. Every scrambled point is uniform, and the
/// equidistribution of a set is kept: dyadic intervals of a length map to dyadic intervals of that
/// length.
///
/// @param x the first 32 digits of a number in [0,1)
/// @param seed a different one for each coordinate, which are otherwise scrambled equally
inline std::uint32_t owen_scrambled(std::uint32_t x, std::uint64_t seed) {
  std::uint32_t flips = 0;
  for (int digit = 0; digit < 32; ++digit) {
    // The node of the binary tree given by the digits before this one.
    const std::uint64_t node = (std::uint64_t{1} << digit) | (std::uint64_t{x} >> (32 - digit));
    flips |= static_cast<std::uint32_t>(mixed(seed + node * golden_step) >> 63) << (31 - digit);
  }
  return x ^ flips;
}

}  // namespace transillum
