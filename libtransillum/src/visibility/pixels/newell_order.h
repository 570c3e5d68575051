// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/cancellation.h"
#include "visibility/pixels/outlines.h"
#include "visibility/pixels/patch_heights.h"

namespace transillum {

/// The pieces of a scene in painting order, farthest toward omega first, by the tests of M. E.
/// Newell, R. G. Newell and T. L. Sancha ("A solution to the hidden surface problem", 1972),
/// without splitting. Pieces are sorted by their highest point; a piece that another lies above,
/// even in part, is put after that one.
///
/// Where the original tests would split one of two pieces, heights at the corners of their overlap
/// are compared first.
/// @returns indexes into Scene::pieces(), without edge-on pieces
/// @throws InputError naming the patches, where they overlap in a cycle or intersect; Canceled
std::vector<std::int32_t> newell_order(const Scene& scene, const PixelGrid& grid,
                                       const PieceOutlines& outlines, const PatchHeights& heights,
                                       const Cancellation& cancellation);

}  // namespace transillum
