// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cmath>

#include "transillum/vec3.h"

namespace transillum {

/// The unit vector along a direction that a user gives, of any length. It is scaled first, since
/// squares of huge numbers overflow and squares of tiny ones underflow; by a power of two, so a
/// unit vector is not changed.
/// @param direction finite, not zero.
inline Vec3 unit_vector(const Vec3& direction) {
  int exponent = 0;
  std::frexp(max_abs(direction), &exponent);
  return normalized(Vec3{std::ldexp(direction.x, -exponent), std::ldexp(direction.y, -exponent),
                         std::ldexp(direction.z, -exponent)});
}

}  // namespace transillum
