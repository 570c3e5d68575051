// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>

#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// A corner relative to a bin's center, with its height in a NeedleFrame, if any.
struct WidePoint {
  long double x, y, height;
};
using WidePolygon = std::array<WidePoint, FragmentOutlines::max_corners + 4>;

/// Clips a polygon of `count` corners by the sides of a square of width 2 `half` around the origin;
/// returns the number of corners that remain.
std::size_t clip_to_bin(WidePolygon& polygon, std::size_t count, long double half);

}  // namespace transillum
