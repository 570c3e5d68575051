// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "transillum/visibility_map.h"
#include "visibility/pixels/pixel_engines.h"

namespace transillum {

/// The item buffer of a discrete engine: the patch visible at each pixel along one direction,
/// upward.
struct PixelMap {
  static constexpr int default_resolution = 128;   ///< pixels along the longer side
  static constexpr int largest_resolution = 1024;  ///< pixels along the longer side

  PlaneFrame frame;             ///< frame of the direction
  Vec2 corner;                  ///< corner of the first pixel, m along frame.u and frame.v
  double side = 0;              ///< side of a pixel, m
  int columns = 0;              ///< pixels along u
  int rows = 0;                 ///< pixels along v
  PatchId receiver = no_patch;  ///< seen from this patch; no_patch: from below the scene
  std::vector<PatchId> items;   ///< per pixel, row by row along u, rows along v; no_patch: empty
  std::vector<bool> window;     ///< per pixel: the receiver covers it; empty without a receiver
  std::vector<Transfer> exchanges;  ///< all exchanges along the direction, sorted by receiver

  /// Index of a pixel in `items` and `window`.
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Whether an engine samples the plane in pixels: zbuffer, painter and rays do.
bool has_pixels(Engine engine);

/// Runs engine zbuffer, painter or rays (one line per pixel) on one direction.
/// @param engine with its options.
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param omega unit.
/// @param receiver a patch, or no_patch: what is visible from below the scene.
/// @param cancellation checked during the pass.
/// @throws InputError for another engine or a resolution above largest_resolution
/// @throws Canceled
PixelMap pixel_map(const PixelEngine& engine, const Scene& scene, const BspTree& tree,
                   const Vec3& omega, PatchId receiver = no_patch,
                   const Cancellation& cancellation = {});

/// The item buffer of the polygons processed up to step `step` of a recorded direction, seen from
/// below.
/// @throws InputError as pixel_map(); also where PaintersOrder::newell fails
/// @throws Canceled
PixelMap pixel_map_after(const PixelEngine& engine, const Scene& scene, const BspTree& tree,
                         const MapRecord& record, std::int32_t step,
                         const Cancellation& cancellation = {});

/// The item buffer as a map for files and pictures: adjacent pixels of a row that show the same
/// patch become a rectangle.
/// @throws Canceled
VisibilityMap drawn_in_pixels(const Scene& scene, const PixelMap& pixels,
                              const Cancellation& cancellation = {});

/// Adds to `drawn`.pixels.differences where the pixels differ from the exact map: convex polygons
/// that do not overlap; `patch` is the patch visible in the exact map, or no_patch.
/// @param pixels the item buffer.
/// @param exact map of the same scene, direction and receiver.
/// @param drawn drawn_in_pixels() of `pixels`.
/// @param cancellation checked during the comparison.
/// @throws Canceled
void mark_differences(const PixelMap& pixels, const VisibilityMap& exact, VisibilityMap& drawn,
                      const Cancellation& cancellation = {});

}  // namespace transillum
