// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "visibility/pixels/patch_heights.h"
#include "visibility/pixels/pixel_engines.h"
#include "visibility/pixels/pixel_grid.h"
#include "visibility/pixels/processed_fragments.h"

namespace transillum {

/// A scene along one direction, with the pixels of the plane.
struct PixelScene {
  const Scene& scene;
  const BspTree& tree;
  const PixelGrid& grid;
  const PatchHeights& heights;
};

/// Records in `sink` what engine zbuffer, painter or rays (gridded, one line per pixel) finds at
/// the pixels of the grid.
/// @throws InputError for another engine; Canceled
void sample_visibility(const PixelEngine& engine, const PixelScene& view, VisibilitySink& sink,
                       const Cancellation& cancellation);

/// The same, where `fragments` of the tree are all there is.
void sample_visibility(const PixelEngine& engine, const PixelScene& view,
                       std::span<const FragmentId> fragments, VisibilitySink& sink,
                       const Cancellation& cancellation);

/// sample_visibility() of engine rays: one line along the direction per pixel.
/// @param processed all there is; null: the whole scene
void trace_lines(std::uint64_t seed, const PixelScene& view, const ProcessedFragments* processed,
                 VisibilitySink& sink, const Cancellation& cancellation);

}  // namespace transillum
