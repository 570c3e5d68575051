// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

/// Makes an engine restricted to one patch: its Transfers list only the exchanges in which `patch`
/// is the receiver or the source, with moments if `options` ask for them, equal up to rounding to
/// the Transfers of make_engine(). Coverages are right for the patch only; all other fields are
/// empty. Engine fast processes only the fragments above and below the patch, which in large scenes
/// is a small part of a pass; other engines run a whole pass.
///
/// Keeps scene and tree alive. Threads as for TransferEngine.
/// @param engine any that takes_directions().
/// @param scene the scene.
/// @param tree BSP tree of `scene`.
/// @param patch 0 … scene->patch_count() - 1.
/// @param options as for make_engine().
/// @throws InputError as make_engine()
TransferEngine make_patch_engine(Engine engine, std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch,
                                 const EngineOptions& options = {});

}  // namespace transillum
