// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Edits of a description before a Scene is made of it: faces are moved, copied, removed and added.
// Faces are named by their indices in the description; lists of them are ascending. Faces that are
// not concerned keep their corners to the bit, and all keep their material, group and number.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/edit/face_placement.h"
#include "transillum/scene.h"

namespace transillum {

/// Indices of faces, ascending.
using FaceList = std::vector<std::int32_t>;

/// The faces whose number (SceneDescription::number_of()) is `number`.
FaceList faces_of_number(const SceneDescription& description, std::int32_t number);
/// The faces of a group; empty for no_group.
FaceList faces_of_group(const SceneDescription& description, std::int32_t group);
/// The connected component of a face: the faces that can be reached from it over edges that are the
/// same in coordinates. Time: O(n log n) in the corners.
FaceList faces_of_object(const SceneDescription& description, std::int32_t face);
/// The connected component of a face that emits among those that emit, or of the first one that
/// emits if it does not; empty in a scene without a lamp.
FaceList faces_of_lamp(const SceneDescription& description, std::int32_t face);

/// The box around faces. Requires a face.
Bounds bounds_of(const SceneDescription& description, std::span<const std::int32_t> faces);

/// Moves faces. A corner that others share stays theirs, and the moved faces get a new point.
/// @throws InputError where a factor is not positive, or a coordinate is not finite
void place_faces(SceneDescription& description, std::span<const std::int32_t> faces,
                 const Vec3& pivot, const FacePlacement& placement);
/// Removes faces; the numbers of the others stay.
void remove_faces(SceneDescription& description, std::span<const std::int32_t> faces);
/// Copies faces, translated by `move`, with new numbers.
/// @returns the copies, which are the last faces
FaceList copy_faces(SceneDescription& description, std::span<const std::int32_t> faces,
                    const Vec3& move);

/// The kinds of things that add_solid() adds.
enum class AddedSolid {
  box,    ///< six faces that light outward
  board,  ///< a level two-sided face
  lamp,   ///< a level face that emits downward
  room,   ///< six faces that light inward
};
/// Adds faces with a group of their own, a gray material, or of a lamp one that emits 10 W/m².
/// @param size edges along x, y and z, m, > 0; of a board and a lamp, the edge along `up` is unused
/// @param up axis of the vertical
/// @returns the added faces, which are the last ones
FaceList add_solid(SceneDescription& description, AddedSolid solid, const Vec3& center,
                   const Vec3& size, int up);

}  // namespace transillum
