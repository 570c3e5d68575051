// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of BoundaryView: cutting the boundary segments of a region by a convex polygon.
// simd_backend.cpp implements set_cutter(), cut_boundary() and extent_of() by the widest backend
// that the processor supports.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "visibility/queries/grid_projection.h"

namespace transillum {

/// Directed boundary segments of a region, in no particular order; the region is on their left.
/// The segments form closed loops: each end point is the start point of another segment, bit for
/// bit. Coordinates in grid units, relative to an origin chosen by the caller.
struct BoundarySegments {
  static constexpr std::size_t max_count = 64;  ///< most segments of a region that is cut
  /// Each cut segment may leave two parts; backends write up to eight more at once.
  static constexpr std::size_t capacity = 2 * max_count + 8;
  std::size_t count = 0;
  alignas(64) std::array<double, capacity> ax, ay, bx, by;  ///< from a to b

  void add(double from_x, double from_y, double to_x, double to_y) {
    ax[count] = from_x;
    ay[count] = from_y;
    bx[count] = to_x;
    by[count++] = to_y;
  }
};

/// The convex polygon that cuts a region: counter-clockwise, relative to the region's origin. Edge
/// m runs from corner m to corner m + 1.
struct Cutter {
  static constexpr std::size_t max_edges = 16;
  alignas(64) std::array<double, max_edges> x, y;  ///< corners
  /// Edge lines: inside where dx y - dy x + c > 0. dx x + dy y equals `middle` at the middle of the
  /// edge.
  alignas(64) std::array<double, max_edges> dx, dy, c, middle;
  alignas(64) std::array<double, max_edges> length;  ///< |dx| + |dy|
  std::size_t count = 0;
  double perimeter = 0;  ///< sum of the lengths
  double tolerance = 0;  ///< distance outside a line at which a point is treated as on it
  double pivot_x = 0, pivot_y = 0;  ///< areas are measured relative to this point
};

/// Sets all of a cutter but tolerance and pivot from corners on the grid. Lines through points
/// farther than `far` from the origin are computed in long double: they may still pass near the
/// region.
void set_cutter(Cutter& cutter, const GridPoint* corners, std::size_t count,
                const GridPoint& origin, double far);

/// Result of cutting a region: for each segment the part inside the cutter, from (in_x, in_y) to
/// (out_x, out_y). The parts outside are stored separately, as BoundarySegments.
struct BoundaryCut {
  std::array<double, BoundarySegments::max_count> in_x, in_y, out_x, out_y;
  std::uint64_t inside;  ///< the segments that have a part inside, one bit per segment
  /// Per edge of the cutter: the segments that enter and leave the cutter through it, one bit per
  /// segment.
  std::array<std::uint64_t, Cutter::max_edges> enters, leaves;
  /// Winding number of the region around each corner of the cutter: 0 or 1, but for rounding.
  std::array<int, Cutter::max_edges> winding;
  double twice_area;  ///< contribution of the inside parts to twice the area of the region inside
};

/// Cuts a region of at most BoundarySegments::max_count segments. Returns false, and leaves `cut`
/// and `outside` unspecified, if the whole region is on the outer side of one of the cutter's
/// lines.
bool cut_boundary(const BoundarySegments& region, const Cutter& cutter, BoundaryCut& cut,
                  BoundarySegments& outside);

/// Largest x, y, x + y and x - y of a region, then the smallest ones negated.
using Extent = std::array<double, 8>;
Extent extent_of(const BoundarySegments& region);

}  // namespace transillum
