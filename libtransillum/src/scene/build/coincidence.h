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

}  // namespace transillum
