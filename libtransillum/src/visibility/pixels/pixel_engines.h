// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

/// An engine that has_pixels().
struct PixelEngine {
  Engine engine;               ///< zbuffer, painter or rays
  EngineOptions options = {};  ///< resolution 0 means PixelMap::default_resolution
};

/// Engine `zbuffer`: all patches over each pixel's center, sorted by height.
TransferEngine zbuffer_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options);
/// Engine `painter`: polygons painted into an item buffer, farthest toward omega first.
TransferEngine painter_engine(std::shared_ptr<const Scene> scene,
                              std::shared_ptr<const BspTree> tree, const EngineOptions& options);
/// Engine `rays`: parallel lines along the direction, intersected by Embree.
/// @throws InputError where options.lines_per_patch is not in (0, 1e6]
TransferEngine ray_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options);

}  // namespace transillum
