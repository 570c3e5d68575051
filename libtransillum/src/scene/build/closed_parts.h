// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// Faces that are connected by edges that two of them share.
struct ConnectedFaces {
  std::vector<std::int32_t> faces;  ///< ascending
  /// Every edge is run along once in each direction, and no face has two lit sides.
  bool closed = false;
};

/// The connected parts of a description, by their first face. Two faces are connected by an edge
/// that they alone share, by its coordinates or by the numbers of its points.
/// @param outlines of all faces, as numbers of distinct points, without repeated corners
std::vector<ConnectedFaces> connected_faces(const SceneDescription& description,
                                            const std::vector<std::vector<PointId>>& outlines);

}  // namespace transillum
