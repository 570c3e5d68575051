// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "transillum/engine.h"
#include "visibility/pixels/patch_heights.h"
#include "visibility/pixels/pixel_grid.h"
#include "visibility/pixels/processed_fragments.h"
#include "visibility/pixels/visibility_sink.h"

namespace transillum {

/// Records in `sink` what engine zbuffer, painter or rays (gridded, one line per pixel) finds at
/// the pixels of `grid`.
/// @throws InputError for another engine; Canceled
void sample_visibility(Engine engine, const Scene& scene, const BspTree& tree,
                       const EngineOptions& options, const PixelGrid& grid,
                       const PatchHeights& heights, VisibilitySink& sink,
                       const Cancellation& cancellation);

/// The same, where `fragments` of the tree are all there is.
void sample_visibility(Engine engine, const Scene& scene, const BspTree& tree,
                       std::span<const FragmentId> fragments, const EngineOptions& options,
                       const PixelGrid& grid, const PatchHeights& heights, VisibilitySink& sink,
                       const Cancellation& cancellation);

/// sample_visibility() of engine rays: one line along the direction per pixel.
/// @param processed all there is; null: the whole scene
void trace_lines(const Scene& scene, std::uint64_t seed, const PixelGrid& grid,
                 const PatchHeights& heights, const ProcessedFragments* processed,
                 VisibilitySink& sink, const Cancellation& cancellation);

}  // namespace transillum
