// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <utility>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// Pairs (face, earliest face with the same set of distinct points), sorted by the first.
/// @param welded for each point of the description its number among the distinct ones
std::vector<std::pair<std::size_t, std::size_t>> coincident_faces(
    const SceneDescription& description, const std::vector<PointId>& welded);

/// SceneReport::covered_faces.
/// @param pairs of coincident_faces()
/// @param patches by face, before refinement or after it; of a refined face the first patch decides
std::vector<std::int32_t> covered_faces(
    const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
    const std::vector<Patch>& patches, const std::vector<Material>& materials);

}  // namespace transillum
