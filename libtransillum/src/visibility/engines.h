// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

// What make_engine() chooses from; one file each.

TransferEngine fast_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree);
/// Right in what it tells of exchanges with `patch`, in nothing else.
TransferEngine fast_patch_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch);
TransferEngine local_map_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree);
TransferEngine global_map_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree);
TransferEngine exact_engine(std::shared_ptr<const Scene> scene,
                            std::shared_ptr<const BspTree> tree);
TransferEngine corrected_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree);
TransferEngine zbuffer_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options);
TransferEngine painter_engine(std::shared_ptr<const Scene> scene,
                              std::shared_ptr<const BspTree> tree, const EngineOptions& options);
TransferEngine ray_engine(std::shared_ptr<const Scene> scene, const EngineOptions& options);

/// Whether surfaces are closed and no lit side looks at a back, whatever the direction.
bool lit_sides_see_no_backs(std::shared_ptr<const Scene> scene,
                            std::shared_ptr<const BspTree> tree);

}  // namespace transillum
