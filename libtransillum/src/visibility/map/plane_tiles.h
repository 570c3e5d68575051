// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <vector>

#include "transillum/cancellation.h"
#include "visibility/plane/exact_number.h"
#include "visibility/plane/plane_index.h"

namespace transillum {

/// A fragment's outline, or the part of it in a tile; counter-clockwise.
struct TilePolygon {
  std::int32_t rank;  ///< place of the fragment in the BSP order
  std::vector<BasicPlanePoint<Rational>> outline;
  PlaneBox box;
};

/// The box of `outline`.
TilePolygon tile_polygon(std::int32_t rank, std::vector<BasicPlanePoint<Rational>> outline);

/// Cuts the plane into tiles in each of which at most `most` polygons have edges, as far as cutting
/// helps, and hands each tile's parts of `polygons` to `use`. The cuts are exact: no part is lost
/// or doubled.
/// @throws Canceled
void for_each_tile(std::vector<TilePolygon> polygons, std::size_t most,
                   const Cancellation& cancellation,
                   const std::function<void(const std::vector<TilePolygon>&)>& use);

}  // namespace transillum
