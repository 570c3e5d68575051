// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Coordinates in which a needle is as high as it is long. One coordinate of the plane is kept, the
// other replaced by the distance from the needle's longest edge, enlarged. The distance is a
// determinant of grid points: exact in 128 bits, and rounded once. So doubles resolve what lies in
// a needle as well as they resolve what lies in a square (decisions/0088-needles.md).
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "visibility/queries/cut_corners.h"
#include "visibility/queries/exact_side.h"

namespace transillum {

/// An affine map of the plane that keeps orientation; areas are multiplied by `determinant`.
struct NeedleFrame {
  /// The coordinate of the plane that is kept.
  enum class Kept {
    both,  ///< the map is a translation
    x,
    y
  };
  GridPoint origin{};  ///< maps to (0, 0)
  GridPoint along{};   ///< vector that maps to (u, 0), u > 0
  Kept kept = Kept::both;
  double scale = 1;  ///< factor of the second coordinate, the determinant of `along` and a vector
  double determinant = 1;

  struct Point {
    double x, y;
  };
  /// A directed line: left of it, dx y - dy x + c > 0.
  struct Line {
    double dx, dy, c;
  };

  /// Sets the direction of the needle, not 0. The scale is left to the caller: set_scale().
  void set_along(const GridPoint& d) {
    const bool steep = std::abs(d.y) > std::abs(d.x);
    kept = steep ? Kept::y : Kept::x;
    along = (steep ? d.y : d.x) < 0 ? GridPoint{-d.x, -d.y} : d;
  }
  void set_scale(double factor) {
    scale = factor;
    determinant = factor * static_cast<double>(kept == Kept::y ? along.y : along.x);
  }

  /// Determinant of `along` and the vector from the origin to a point.
  long double height(const FinePoint& p) const {
    return cross({along}, {{p.grid.x - origin.x, p.grid.y - origin.y}, p.x, p.y});
  }
  /// A translation.
  static NeedleFrame at_origin(const GridPoint& origin) {
    NeedleFrame frame;
    frame.origin = origin;
    return frame;
  }
  /// Coordinates from the first corner of a polygon, in which it is about as high as its longest
  /// edge is long.
  static NeedleFrame around(std::span<const GridPoint> corners);

  Point map(const FinePoint& p) const {
    const auto x = static_cast<double>(p.grid.x - origin.x) + p.x;
    const auto y = static_cast<double>(p.grid.y - origin.y) + p.y;
    if (kept == Kept::both) {
      return {x, y};
    }
    return {kept == Kept::y ? y : x, scale * static_cast<double>(height(p))};
  }
  /// @param x, y from the origin
  Point map(long double x, long double y) const {
    if (kept == Kept::both) {
      return {static_cast<double>(x), static_cast<double>(y)};
    }
    const long double turn =
        static_cast<long double>(along.x) * y - static_cast<long double>(along.y) * x;
    return {static_cast<double>(kept == Kept::y ? y : x), scale * static_cast<double>(turn)};
  }
  /// The line through two points.
  Line map(const FinePoint& from, const FinePoint& to) const {
    const FinePoint d = difference(to, from);
    const double c = determinant * static_cast<double>(cross(d, difference({origin}, from)));
    const double dx = static_cast<double>(d.grid.x) + d.x, dy = static_cast<double>(d.grid.y) + d.y;
    if (kept == Kept::both) {
      return {dx, dy, c};
    }
    return {kept == Kept::y ? dy : dx, scale * static_cast<double>(cross({along}, d)), c};
  }
  /// The inverse, relative to the origin; correct to rounding.
  Point unmap(double x, double y) const {
    const auto ax = static_cast<double>(along.x), ay = static_cast<double>(along.y);
    switch (kept) {
      case Kept::x:
        return {x, (y / scale + ay * x) / ax};
      case Kept::y:
        return {(ax * x - y / scale) / ay, x};
      default:
        return {x, y};
    }
  }

 private:
  static FinePoint difference(const FinePoint& a, const FinePoint& b) {
    return {{a.grid.x - b.grid.x, a.grid.y - b.grid.y}, a.x - b.x, a.y - b.y};
  }
  /// Determinant of two vectors.
  static long double cross(const FinePoint& a, const FinePoint& b) {
    using Wide = long double;
    const auto whole = static_cast<Wide>(static_cast<WideInteger>(a.grid.x) * b.grid.y -
                                         static_cast<WideInteger>(a.grid.y) * b.grid.x);
    if (a.x == 0 && a.y == 0 && b.x == 0 && b.y == 0) {
      return whole;
    }
    const Wide ax = a.x, ay = a.y, bx = b.x, by = b.y;
    const auto gx = static_cast<Wide>(a.grid.x), gy = static_cast<Wide>(a.grid.y);
    const auto hx = static_cast<Wide>(b.grid.x), hy = static_cast<Wide>(b.grid.y);
    return whole + ((gx * by - gy * bx) + (ax * hy - ay * hx) + (ax * by - ay * bx));
  }
};

}  // namespace transillum
