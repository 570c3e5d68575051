// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "transillum/engine.h"
#include "visibility/pixels/patch_heights.h"
#include "visibility/pixels/pixel_grid.h"
#include "visibility/pixels/processed_parts.h"
#include "visibility/pixels/visibility_sink.h"

namespace transillum {

/// Tells `sink` what engine zbuffer, painter or rays (gridded, a line a pixel) finds in the pixels
/// of `grid`.
/// @throws InputError for another engine; Canceled
void fill_pixels(Engine engine, const Scene& scene, const BspTree& tree,
                 const EngineOptions& options, const PixelGrid& grid, const PatchHeights& heights,
                 VisibilitySink& sink, const Cancellation& cancellation);

/// The same as if there were some fragments of the tree alone.
void fill_pixels(Engine engine, const Scene& scene, const BspTree& tree,
                 std::span<const FragmentId> fragments, const EngineOptions& options,
                 const PixelGrid& grid, const PatchHeights& heights, VisibilitySink& sink,
                 const Cancellation& cancellation);

/// The part of fill_pixels() for engine rays.
/// @param parts all there is; null: the whole scene
void cast_lines(const Scene& scene, std::uint64_t seed, const PixelGrid& grid,
                const PatchHeights& heights, const ProcessedParts* parts, VisibilitySink& sink,
                const Cancellation& cancellation);

}  // namespace transillum
