// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "transillum/vec3.h"

namespace transillum {

/// How far a coordinate may be from its value before it was rounded, m: half a unit of the last
/// digit in which the coordinates are given, decimal or binary, or the rounding of doubles if they
/// are given in full.
double coordinate_rounding(std::span<const Vec3> points);

}  // namespace transillum
