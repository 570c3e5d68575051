// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// A point of a plane whose coordinates are taken as exact.
using PlanePoint = std::array<double, 2>;
/// Corners of a polygon, as indices into the polygon it was made from; counter-clockwise.
using CornerList = std::vector<std::uint32_t>;

/// Sign of the area of the triangle a, b, c: exact.
int exact_turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Whether `outline` is the counter-clockwise outline of a convex polygon: exact. Corners on a
/// straight edge are allowed. O(n).
bool is_convex(std::span<const PlanePoint> outline);

/// Whether the outline neither crosses nor touches itself: exact. O(n log n).
bool is_simple(std::span<const PlanePoint> outline);

/// Triangles, each counter-clockwise and with area, that together are what lies inside `outline`
/// by the even-odd rule. The outline may touch itself, as where a hole hangs on a bridge; it may
/// not cross itself: then the result is empty.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const PlanePoint> outline);

/// As triangulate(), but convex polygons: at most four times as many as the least possible
/// (Hertel and Mehlhorn, "Fast triangulation of simple polygons", 1983). O(n log n), which CGAL's
/// own approx_convex_partition_2 is not: it takes minutes for 10^5 corners.
std::vector<CornerList> convex_partition(std::span<const PlanePoint> outline);

}  // namespace transillum
