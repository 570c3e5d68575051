// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "visibility/pixels/patch_heights.h"
#include "visibility/pixels/pixel_grid.h"

namespace transillum {

/// The generalized z-buffer of section 2: records in `sink`, pixel by pixel, all patches over the
/// pixel's center, from above downward. Its memory does not grow with the resolution.
/// @throws Canceled
void fill_zbuffer(const Scene& scene, const PixelGrid& grid, const PatchHeights& heights,
                  VisibilitySink& sink, const Cancellation& cancellation);

/// The same, where `fragments` of the tree are all there is.
void fill_zbuffer(const BspTree& tree, std::span<const FragmentId> fragments, const PixelGrid& grid,
                  const PatchHeights& heights, VisibilitySink& sink,
                  const Cancellation& cancellation);

}  // namespace transillum
