// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "geometry/form_factor.h"
#include "transillum/scene.h"

namespace transillum {

/// Convex polygons whose union is that of the scene's patches; they may overlap. If the patches of
/// a face form a convex polygon, that polygon; otherwise their pieces.
std::vector<Corners> merged_pieces(const Scene& scene);

}  // namespace transillum
