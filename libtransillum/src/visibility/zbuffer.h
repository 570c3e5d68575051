// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "visibility/patch_heights.h"
#include "visibility/pixel_book.h"
#include "visibility/pixel_grid.h"

namespace transillum {

/// The generalised z-buffer of section 2: tells `book`, pixel by pixel, all patches over the
/// pixel's centre from above downward. What it keeps at a time does not grow with the resolution.
/// @throws Cancelled
void fill_zbuffer(const Scene& scene, const PixelGrid& grid, const PatchHeights& heights,
                  PixelBook& book, const Cancellation& cancellation);

/// The same of some fragments of a tree alone.
void fill_zbuffer(const BspTree& tree, std::span<const FragmentId> fragments, const PixelGrid& grid,
                  const PatchHeights& heights, PixelBook& book, const Cancellation& cancellation);

}  // namespace transillum
