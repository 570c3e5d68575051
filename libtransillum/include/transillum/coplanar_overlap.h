// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "transillum/bsp_tree.h"

namespace transillum {

/// Two patches of one plane, lit on the same side, of which one lies over the other.
struct CoplanarOverlap {
  PatchId upper;  ///< lights and receives where they overlap, see BspTree::order()
  PatchId lower;
  double area;  ///< of the overlap, m², less a strip of BspTree::thickness() at its borders; > 0

  friend bool operator==(const CoplanarOverlap&, const CoplanarOverlap&) = default;
};

/// The overlaps of coplanar patches, by upper, then lower patch; at most about `most` of them.
///
/// Strips narrower than BspTree::thickness() are patches that touch. Patches lit on opposite sides
/// are the two sides of one surface and no overlap.
/// @throws Canceled
std::vector<CoplanarOverlap> coplanar_overlaps(const Scene& scene, const BspTree& tree,
                                               std::size_t most,
                                               const Cancellation& cancellation = {});

}  // namespace transillum
