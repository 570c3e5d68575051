// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "transillum/vec3.h"

namespace transillum {

/// Distance of 1 from the next double.
inline constexpr double epsilon = 0x1p-52;
/// Distance of a corner from its face's plane by rounding, relative to that of a coordinate: up to
/// sqrt(3) each for the corner and the plane.
inline constexpr double bend_by_rounding = 4;

/// How far a coordinate may be from its value before it was rounded, m: half a unit of the last
/// digit in which the coordinates are given, decimal or binary, or the rounding of doubles if they
/// are given in full.
double coordinate_rounding(std::span<const Vec3> points);

}  // namespace transillum
