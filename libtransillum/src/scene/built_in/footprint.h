// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/vec3.h"

namespace transillum {

/// A convex floor minus a convex footprint of something that stands on it: convex parts, cut along
/// the lines of the footprint's edges like a pinwheel. Both outlines are counter-clockwise about
/// `up`. If the two do not overlap, the result is the whole floor.
///
/// If the floor continued under a block, it would see the inside of the block, and its radiosity
/// would be averaged over a region that no light reaches.
std::vector<std::vector<Vec3>> floor_around(const std::vector<Vec3>& floor,
                                            const std::vector<Vec3>& footprint, const Vec3& up);

/// The same for several footprints that do not overlap.
std::vector<std::vector<Vec3>> floor_around_all(const std::vector<Vec3>& floor,
                                                const std::vector<std::vector<Vec3>>& footprints,
                                                const Vec3& up);

}  // namespace transillum
