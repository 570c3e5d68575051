// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// Faces joined to larger ones, and where each has gone.
struct JoinedFaces {
  SceneDescription description;
  /// By face of the original: its face in `description`.
  std::vector<std::int32_t> face_of;
};

/// Joins faces of one plane, up to the rounding of the coordinates, that share edges, the material,
/// the group and the number of sides. Each joined face is a polygon without holes, in which a
/// corner occurs once: a wall around a window becomes two faces or more. Corners inside straight
/// edges of all faces are removed; so the faces meet as before. A joined face has the
/// face_number of its first part, by which the result is ordered.
/// @param original with valid indices; points with equal coordinates are one point in the result
/// Time: n log n in the corners.
/// @throws Canceled
JoinedFaces join_faces(const SceneDescription& original, const Cancellation& cancellation);

}  // namespace transillum
