// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

/// Engine `fast`: visible areas in doubles, with exact signs where doubles do not suffice.
/// @param moments whether it computes Transfers::moments
/// @throws Canceled when the engine is called
TransferEngine fast_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree,
                           bool moments = false);
/// Engine `fast`, restricted to the exchanges of one patch; all other transfers are incomplete.
TransferEngine fast_patch_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch,
                                 bool moments = false);
/// Engine `corrected`: no cutting; partly hidden areas are corrected (the paper's section 8).
TransferEngine corrected_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree);

/// Whether all surfaces are closed and no front side sees a back side along any direction
/// (decisions/0015-closed-surfaces.md). Takes one pass of engine fast.
bool fronts_see_no_backs(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree);

}  // namespace transillum
