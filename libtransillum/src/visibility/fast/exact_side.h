// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "visibility/fast/grid_projection.h"

namespace transillum {

/// The line through two points of the grid, from a to b.
struct GridLine {
  GridPoint a, b;
};

__extension__ typedef __int128 WideInteger;

/// Twice the area of the triangle a, b, c; exact.
inline WideInteger exact_turn(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  return static_cast<WideInteger>(b.x - a.x) * (c.y - a.y) -
         static_cast<WideInteger>(b.y - a.y) * (c.x - a.x);
}

/// Twice the area of the triangle of `line` and `p`: > 0 where p lies left of it. The sign is
/// exact, the value right to rounding.
long double exact_side(const GridLine& line, const GridPoint& p);

/// The same for the point where lines `p` and `q` meet; 0 where they are parallel.
long double exact_side(const GridLine& line, const GridLine& p, const GridLine& q);

/// Where two lines meet, relative to `origin`; right to rounding however flat their angle.
struct Meeting {
  bool parallel;
  long double x, y;
};
Meeting exact_meeting(const GridLine& p, const GridLine& q, const GridPoint& origin);

}  // namespace transillum
