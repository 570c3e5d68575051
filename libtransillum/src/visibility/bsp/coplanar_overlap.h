// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// Two coplanar patches with the same normal, one of which covers part of the other.
struct CoplanarOverlap {
  PatchId upper;  ///< the one that emits and receives in the overlap; see BspTree::order()
  PatchId lower;  ///< the covered one
  double area;    ///< m², without a border strip as wide as BspTree::thickness(); > 0

  /// Exact comparison of all members.
  friend bool operator==(const CoplanarOverlap&, const CoplanarOverlap&) = default;
};

/// The overlaps of coplanar patches, sorted by upper, then lower patch.
///
/// An overlap narrower than BspTree::thickness() does not count: such patches touch. Patches with
/// opposite normals are the two sides of one surface and do not overlap.
/// Time: near-linear in the pieces, as far as few of their bounding boxes overlap.
/// @param most the search stops after about this many overlaps.
/// @param cancellation checked during the search.
/// @throws Canceled
std::vector<CoplanarOverlap> coplanar_overlaps(const Scene& scene, std::size_t most,
                                               const Cancellation& cancellation = {});

}  // namespace transillum
