// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cmath>

namespace transillum {

/// The power of two that brings |x| into [1, 2), for x of magnitude 2^-1000 to 2^1000; 1 for 0.
/// Multiplying by it is exact, so sums of squares, or numbers in single precision, can be
/// calculated in units of the data's own size without changing a bit of the result.
inline double scale_to_one(double x) {
  constexpr int largest = 1000;
  return x == 0 || !std::isfinite(x)
             ? 1.0
             : std::ldexp(1.0, -std::clamp(std::ilogb(x), -largest, largest));
}

}  // namespace transillum
