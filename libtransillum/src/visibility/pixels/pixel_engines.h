// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

/// Engine `zbuffer`: the nearest patch at each pixel.
TransferEngine zbuffer_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options);
/// Engine `painter`: patches painted into pixels, farthest first.
TransferEngine painter_engine(std::shared_ptr<const Scene> scene,
                              std::shared_ptr<const BspTree> tree, const EngineOptions& options);
/// Engine `rays`: parallel lines, intersected by Embree.
TransferEngine ray_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options);

}  // namespace transillum
