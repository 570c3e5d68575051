// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "transillum/visibility_map.h"

namespace transillum {

/// What a discrete engine sees of a scene along one direction, upward: an item buffer.
struct PixelMap {
  static constexpr int default_resolution = 128, largest_resolution = 1024;

  PlaneFrame frame;
  Vec2 corner;      ///< of the first pixel, meters along frame.u and frame.v
  double side = 0;  ///< of a pixel, meters
  int columns = 0, rows = 0;
  PatchId receiver = no_patch;      ///< who looks up; no_patch: somebody below the whole scene
  std::vector<PatchId> items;       ///< row by row along u, rows along v; no_patch: nothing there
  std::vector<bool> window;         ///< the receiver's pixels; empty without one
  std::vector<Transfer> exchanges;  ///< who sees whom along the direction, by receiver

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Whether an engine sees the plane in pixels: zbuffer, painter and rays do.
bool has_pixels(Engine engine);

/// Runs engine zbuffer, painter or rays (a line a pixel) on one direction.
/// @param options of the engine; its resolution 0 means PixelMap::default_resolution.
/// @throws InputError for another engine, or a resolution beyond largest_resolution; Canceled
PixelMap pixel_map(Engine engine, const std::shared_ptr<const Scene>& scene,
                   const std::shared_ptr<const BspTree>& tree, const Vec3& omega,
                   PatchId receiver = no_patch, const EngineOptions& options = {},
                   const Cancellation& cancellation = {});

/// The same of V after step `step` of a recorded direction: of the polygons processed so far.
/// @throws InputError too where the painter's order newell gives up
PixelMap pixel_map_after(Engine engine, const Scene& scene, const BspTree& tree,
                         const MapRecord& record, std::int32_t step, const EngineOptions& options,
                         const Cancellation& cancellation = {});

/// The pixels as a map for files and pictures: runs of pixels that show the same, as rectangles.
/// @throws Canceled
VisibilityMap drawn_in_pixels(const Scene& scene, const PixelMap& pixels,
                              const Cancellation& cancellation = {});

/// Adds to `drawn`.pixels.differences where the pixels show not what is there: convex polygons that
/// do not overlap. Of each, `patch` is what is truly seen, or no_patch.
/// @param exact map of the same scene, direction and receiver.
/// @throws Canceled
void mark_differences(const PixelMap& pixels, const VisibilityMap& exact, VisibilityMap& drawn,
                      const Cancellation& cancellation = {});

}  // namespace transillum
