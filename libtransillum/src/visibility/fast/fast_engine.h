// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <vector>

#include "transillum/engine.h"
#include "visibility/queries/query_cost.h"

namespace transillum {

/// Engine `fast`: visible areas in doubles, with exact signs where doubles do not suffice.
/// @param moments whether it computes Transfers::moments
/// @param cancellation of making it
/// @throws Canceled
TransferEngine fast_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree,
                           bool moments = false, const Cancellation& cancellation = {});
/// Engine `fast`, restricted to the exchanges of one patch; all other transfers are incomplete.
TransferEngine fast_patch_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch,
                                 bool moments = false);
/// Engine `fast`, to be called by one thread at a time: adds the cost of each query to its patch.
/// @param costs one per patch when the engine is called; must outlive it.
TransferEngine measured_fast_engine(std::shared_ptr<const Scene> scene,
                                    std::shared_ptr<const BspTree> tree, bool moments,
                                    std::vector<PatchCost>& costs);
/// Engine `corrected`: no cutting; partly hidden areas are corrected (the paper's section 8).
TransferEngine corrected_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree);

/// Whether all surfaces are closed and no front side sees a back side along any direction
/// (decisions/0015-closed-surfaces.md). Takes one pass of engine fast.
bool fronts_see_no_backs(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree);

}  // namespace transillum
