// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/cancellation.h"
#include "visibility/pixels/outlines.h"
#include "visibility/pixels/patch_heights.h"

namespace transillum {

/// The pieces of a scene for the painter, those farthest toward omega first, by the tests of M. E.
/// Newell, R. G. Newell and T. L. Sancha ("A solution to the hidden surface problem", 1972):
/// nothing is cut. Pieces come by their highest point; one that another lies above, in part, waits
/// for that one.
///
/// Where their tests would cut two pieces in doubt, heights over the corners of their overlap
/// decide first.
/// @throws InputError naming the patches, where they overlap in a circle or cut through each other;
/// Canceled
std::vector<std::int32_t> newell_order(const Scene& scene, const PixelGrid& grid,
                                       const PieceOutlines& outlines, const PatchHeights& heights,
                                       const Cancellation& cancellation);

}  // namespace transillum
