// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "visibility/fast/grid_projection.h"

namespace transillum {

/// Directed segments, in no order, that together bound a region on their left. Where one ends
/// another begins, at the same coordinates to the last bit.
struct Outline {
  static constexpr std::size_t most = 64;            ///< of a region that is cut
  static constexpr std::size_t room = 2 * most + 8;  ///< each may leave two parts; and 8 at once
  std::size_t count = 0;
  alignas(64) std::array<double, room> ax, ay, bx, by;  ///< from a to b

  void add(double from_x, double from_y, double to_x, double to_y) {
    ax[count] = from_x;
    ay[count] = from_y;
    bx[count] = to_x;
    by[count++] = to_y;
  }
};

/// What cuts an outline: a convex polygon, counter-clockwise, relative to some origin. Edge m runs
/// from corner m to the next.
struct Cutter {
  static constexpr std::size_t most = 16;
  alignas(64) std::array<double, most> x, y;  ///< corners
  /// Edge lines: inside dx y - dy x + c > 0. dx x + dy y is `middle` halfway along the edge.
  alignas(64) std::array<double, most> dx, dy, c, middle;
  alignas(64) std::array<double, most> length;  ///< |dx| + |dy|
  std::size_t count = 0;
  double perimeter = 0;             ///< the lengths' sum
  double tolerance = 0;             ///< how far outside a line a point counts as on it
  double pivot_x = 0, pivot_y = 0;  ///< areas are measured relative to this point
};

/// Sets all but tolerance and pivot of a cutter from corners on the grid. Lines through points
/// farther than `far` are made in long double: they may pass near all the same.
void set_cutter(Cutter& cutter, const GridPoint* corners, std::size_t count,
                const GridPoint& origin, double far);

/// What became of an outline. The segments' parts outside the cutter are in another outline; the
/// parts inside run from (in_x, in_y) to (out_x, out_y).
struct OutlineCut {
  std::array<double, Outline::most> in_x, in_y, out_x, out_y;
  /// Which segments come in and go out over an edge of the cutter, one bit a segment.
  std::array<std::uint64_t, Cutter::most> comes_in, goes_out;
  /// How often the region winds around a corner of the cutter: 0 or 1, but for rounding.
  std::array<int, Cutter::most> winding;
  double twice_area;  ///< what the parts inside add to twice the area of the region inside
};

/// Cuts an outline of no more than Outline::most segments. Returns false, and nothing else, where
/// a line of the cutter has all of it on the outer side.
bool cut_outline(const Outline& outline, const Cutter& cutter, OutlineCut& cut, Outline& outside);

/// Largest x, y, x + y and x - y of an outline, then the smallest ones negated.
using Extent = std::array<double, 8>;
Extent extent_of(const Outline& outline);

}  // namespace transillum
