// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "geometry/form_factor.h"
#include "transillum/scene.h"

namespace transillum {

/// Convex polygons that together cover what the scene's patches do, some of them more than once:
/// where the patches of one face make up a convex polygon, that; else their pieces.
std::vector<Corners> merged_pieces(const Scene& scene);

}  // namespace transillum
