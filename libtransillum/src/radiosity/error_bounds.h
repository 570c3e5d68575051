// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cmath>

#include "transillum/vec3.h"

namespace transillum {

/// Bound of the distance from the value before the last iteration to the limit (eq. 23).
/// @param change of the last iteration, maximum norm
/// @param contraction factor per iteration; infinite result where it is not below 1
inline double distance_to_limit(double change, double contraction) {
  if (!(change > 0)) {
    return 0;
  }
  return contraction < 1 ? change / (1 - contraction) : HUGE_VAL;
}

/// sqrt(a² + b²), per channel; in range wherever the result is.
inline Rgb root_of_squares(const Rgb& a, const Rgb& b) {
  return {std::hypot(a.r, b.r), std::hypot(a.g, b.g), std::hypot(a.b, b.b)};
}

}  // namespace transillum
