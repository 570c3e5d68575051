// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/vec3.h"

namespace transillum {

/// What is left of a convex floor where something with a convex footprint stands on it: convex
/// parts, cut along the lines of the footprint's edges like a pinwheel. Both outlines are
/// counter-clockwise about `up`. Where the two do not overlap the floor comes back whole.
///
/// A floor that went on under the block would look at its inside, and its radiosity would be the
/// mean over a part that no light reaches.
std::vector<std::vector<Vec3>> floor_around(const std::vector<Vec3>& floor,
                                            const std::vector<Vec3>& footprint, const Vec3& up);

/// The same for several blocks, that stand apart.
std::vector<std::vector<Vec3>> floor_around_all(const std::vector<Vec3>& floor,
                                                const std::vector<std::vector<Vec3>>& footprints,
                                                const Vec3& up);

}  // namespace transillum
