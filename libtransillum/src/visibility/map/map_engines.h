// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "transillum/engine.h"

namespace transillum {

/// Engine `local`: the local visibility map of section 3.2.
/// @param moments whether it computes Transfers::moments
TransferEngine local_map_engine(std::shared_ptr<const Scene> scene,
                                std::shared_ptr<const BspTree> tree, bool moments = false);
/// Engine `global`: the global visibility map of section 3.1, a CGAL arrangement.
TransferEngine global_map_engine(std::shared_ptr<const Scene> scene,
                                 std::shared_ptr<const BspTree> tree);
/// Engine `exact`: the local visibility map in exact numbers. Moments are integrated in doubles
/// over its exact polygons.
TransferEngine exact_engine(std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree,
                            bool moments = false);

}  // namespace transillum
