// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <vector>

#include "transillum/cancellation.h"
#include "visibility/plane/exact_number.h"
#include "visibility/plane/plane_index.h"

namespace transillum {

/// A projected fragment, or the part of it in a tile; counter-clockwise.
struct TilePolygon {
  std::int32_t rank;  ///< position of the fragment in the BSP order
  std::vector<BasicPlanePoint<Rational>> outline;
  PlaneBox box;
};

/// The polygon with the bounding box of `outline`.
TilePolygon tile_polygon(std::int32_t rank, std::vector<BasicPlanePoint<Rational>> outline);

/// Splits the plane into tiles and calls `visit` with the parts of `polygons` in each. A tile is
/// split as long as more than `max_boundaries` polygons have edges in it and splitting lowers that
/// number. Cuts are exact: no part is lost or duplicated.
/// @throws Canceled
void for_each_tile(std::vector<TilePolygon> polygons, std::size_t max_boundaries,
                   const Cancellation& cancellation,
                   const std::function<void(const std::vector<TilePolygon>&)>& visit);

}  // namespace transillum
