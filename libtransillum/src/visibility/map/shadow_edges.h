// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/visibility_map.h"

namespace transillum {

/// A straight part of the edge of a shadow on a patch.
struct ShadowEdge {
  PatchId patch = no_patch;  ///< the patch that is lit on one side of it
  Vec3 a, b;                 ///< its ends in the plane of the patch, m
};

/// The edges of the shadows cast by light that enters the scene along omega: edges of the polygons
/// of V that are seen from below after the last step, lifted back to their patches. Edges on the
/// outline of their patch are omitted.
/// @param tree of `scene`
/// @param record of a direction, with all its steps
/// @returns sorted by patch
std::vector<ShadowEdge> shadow_edges(const Scene& scene, const BspTree& tree,
                                     const MapRecord& record);
/// The same for light that some patches emit, opposite to omega: the edges of what receiving
/// patches see of them.
/// @param emits  one per patch
std::vector<ShadowEdge> lamp_shadow_edges(const Scene& scene, const BspTree& tree,
                                          const MapRecord& record, const std::vector<bool>& emits);

}  // namespace transillum
