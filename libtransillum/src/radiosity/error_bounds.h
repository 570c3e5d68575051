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

/// The same of each channel.
inline Rgb distances_to_limit(const Rgb& changes, double contraction) {
  return {distance_to_limit(changes.r, contraction), distance_to_limit(changes.g, contraction),
          distance_to_limit(changes.b, contraction)};
}

/// sqrt(a² + b²), per channel; in range wherever the result is.
inline Rgb root_of_squares(const Rgb& a, const Rgb& b) {
  return {std::hypot(a.r, b.r), std::hypot(a.g, b.g), std::hypot(a.b, b.b)};
}

}  // namespace transillum
