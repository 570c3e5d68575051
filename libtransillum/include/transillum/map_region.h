// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <vector>

#include "transillum/map_history.h"

namespace transillum {

/// A region of the global visibility map (paper, section 3.1): all of the plane that a path can
/// reach without crossing the edge of a fragment. Over it the same fragments lie above one another.
struct MapRegion {
  double area = 0;  ///< A(R), m²
  /// Convex polygons that do not overlap, and make it up.
  std::vector<std::vector<Vec2>> parts;
};

/// The region of a direction's map that `point` lies in, to rounding of the history's corners.
/// Nothing where no fragment lies over the point, where it lies on an edge, or where the region's
/// surroundings fall into more than 2,000 pieces. Time grows with the fragments, and with the
/// square of those pieces.
std::optional<MapRegion> region_at(const MapHistory& history, const Vec2& point);

}  // namespace transillum
