// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

#include "base/bit_mixing.h"

namespace transillum {

/// Owen's nested uniform scrambling in base 2: each binary digit of x is flipped or not by a coin
/// that depends on all digits before it. Points scrambled so are uniform each, and what they have
/// in common by twos, fours, … stays: dyadic intervals of one length go to dyadic intervals.
///
/// @param x the first 32 digits of a number in [0,1)
/// @param seed one a coordinate, or coordinates are scrambled alike
inline std::uint32_t owen_scrambled(std::uint32_t x, std::uint64_t seed) {
  std::uint32_t flips = 0;
  for (int digit = 0; digit < 32; ++digit) {
    // The node of the binary tree where the digits before this one lead.
    const std::uint64_t node = (std::uint64_t{1} << digit) | (std::uint64_t{x} >> (32 - digit));
    flips |= static_cast<std::uint32_t>(mixed(seed + node * golden_step) >> 63) << (31 - digit);
  }
  return x ^ flips;
}

}  // namespace transillum
