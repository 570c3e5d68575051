// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace transillum {

/// A point of a plane; its coordinates are regarded as exact.
using PlanePoint = std::array<double, 2>;
/// Corners of a polygon as indices into the outline that it is a part of; counter-clockwise.
using CornerList = std::vector<std::uint32_t>;

/// Sign of the signed area of the triangle a, b, c: exact.
int exact_turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);

/// Whether `outline` is the counter-clockwise outline of a convex polygon: exact. Corners on a
/// straight edge are allowed. O(n).
bool is_convex(std::span<const PlanePoint> outline);

/// Whether the outline neither crosses nor touches itself: exact. O(n log n).
bool is_simple(std::span<const PlanePoint> outline);

/// Triangulates the inside of `outline` by the even-odd rule. Every triangle is counter-clockwise
/// and has a positive area. The outline may touch itself, as where a bridge connects a hole; if it
/// crosses itself, the result is empty.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const PlanePoint> outline);

/// Like triangulate(), but with convex polygons, at most four times the minimum number (Hertel and
/// Mehlhorn, "Fast triangulation of simple polygons", 1983). O(n log n); CGAL's
/// approx_convex_partition_2 takes minutes for 10^5 corners.
std::vector<CornerList> convex_partition(std::span<const PlanePoint> outline);

}  // namespace transillum
