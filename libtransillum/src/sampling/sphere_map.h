// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "transillum/directions.h"

namespace transillum {

/// Eq. 13: maps a point of the unit square to a direction; uniform points give uniform directions.
inline DirectionSample sample_at(double u, double v) {
  const double psi = 2 * std::numbers::pi * u;
  const double cos_theta = 1 - 2 * v;
  const double sin_theta = std::sqrt(std::max(0.0, 4 * v * (1 - v)));
  return {u, v, {sin_theta * std::cos(psi), sin_theta * std::sin(psi), cos_theta}};
}

/// The inverse: maps a unit vector to its point of the unit square.
inline DirectionSample sample_along(const Vec3& direction) {
  const double turns = std::atan2(direction.y, direction.x) / (2 * std::numbers::pi);
  const double u = turns < 0 ? turns + 1 : turns;
  // turns + 1 may round to 1, which represents u = 0.
  return {u < 1 ? u : 0, std::clamp((1 - direction.z) / 2, 0.0, 1.0), direction};
}

}  // namespace transillum
