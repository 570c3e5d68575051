// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "visibility/queries/grid_projection.h"

namespace transillum {

/// The line through two points of the grid, from a to b.
struct GridLine {
  GridPoint a, b;
};

__extension__ typedef __int128 WideInteger;  // NOLINT(modernize-use-using)

/// Twice the area of the triangle a, b, c; exact.
inline WideInteger exact_turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return static_cast<WideInteger>(b.x - a.x) * (c.y - a.y) -
         static_cast<WideInteger>(b.y - a.y) * (c.x - a.x);
}

/// Twice the area of the triangle of `line` and `p`, in square grid units: > 0 if p lies left of
/// the line. The sign is exact, the value correct to rounding.
long double exact_side(const GridLine& line, const GridPoint& p);

/// The same for the point where lines `p` and `q` meet; 0 if they are parallel.
long double exact_side(const GridLine& line, const GridLine& p, const GridLine& q);

/// The point where two lines meet, in grid units from an origin; correct to rounding, however small
/// the angle between the lines.
struct Meeting {
  bool parallel;
  long double x, y;  ///< 0 if parallel
};
Meeting exact_meeting(const GridLine& p, const GridLine& q, const GridPoint& origin);

}  // namespace transillum
