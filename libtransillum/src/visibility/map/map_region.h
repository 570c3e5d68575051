// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <vector>

#include "visibility/map/map_history.h"

namespace transillum {

/// A region R of the global visibility map (paper, section 3.1): a maximal connected part of the
/// plane that contains no edge of a projected fragment. The same fragments cover all of its points.
struct MapRegion {
  double area = 0;  ///< A(R), m²
  /// Convex polygons that do not overlap and whose union is the region.
  std::vector<std::vector<Vec2>> parts;
};

/// The region of the global visibility map that contains `point`, up to the rounding of the
/// history's corners. Time grows with the number of fragments, and with the square of the number of
/// parts examined.
/// @param history of a direction.
/// @param point of the transillumination plane.
/// @returns nothing if no fragment covers the point, if it lies on an edge, or if its neighborhood
/// is cut into more than 2,000 parts.
std::optional<MapRegion> region_at(const MapHistory& history, const Vec2& point);

}  // namespace transillum
