// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

/// An engine that tells of one patch only: of its Transfers, `exchanges` holds those in which
/// `patch` receives or is the source, the same up to rounding as make_engine() finds, and nothing
/// else is filled in. The fast engine looks only at what lies above and below the patch, which on
/// large scenes takes a small part of a pass; other engines make a whole pass.
///
/// Keeps scene and tree alive. `tree` is `scene`'s; threads as TransferEngine.
/// @throws InputError as make_engine()
TransferEngine make_patch_engine(Engine engine, std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree, PatchId patch,
                                 const EngineOptions& options = {});

}  // namespace transillum
