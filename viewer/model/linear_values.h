// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/snapshot.h"
#include "transillum/visibility_map.h"

namespace transillum::viewer {

/// The value at a point of a linear function on a patch.
/// @param mean  over the patch
Rgb value_at(const Rgb& mean, const LinearPart& part, const LinearBasis& basis, const Vec3& point);

/// B at a point of patch i, W/m², which may be below 0; the mean of the patch where B is constant
/// on patches.
Rgb radiosity_at(const SolverSnapshot& snapshot, PatchId i, const Vec3& point);

/// SolveStatistics::negative_corners of the snapshot.
std::int64_t count_negative_corners(const SolverSnapshot& snapshot);

/// Where the line through the point `p` of a plane, along its direction, meets the plane of a
/// patch; none where the patch is edge-on.
std::optional<Vec3> point_of_patch(const PlaneFrame& frame, const Vec2& p, const Patch& patch);

}  // namespace transillum::viewer
