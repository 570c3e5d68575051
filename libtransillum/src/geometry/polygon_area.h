// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <type_traits>

namespace transillum {

/// Area of a plane polygon by the shoelace formula; > 0 if the corners run counter-clockwise.
/// Computed relative to the first corner, so that small polygons far from the origin keep their
/// digits; the sum runs over the corners in order, which fixes its rounding.
/// @param count number of corners; the area of fewer than 3 is 0.
/// @param corner corner(k) returns corner k, k < count, with coordinates x and y of any number
/// type.
template <class CornerAt>
auto polygon_area(std::size_t count, CornerAt&& corner) {
  using Number = std::remove_cvref_t<decltype(corner(0).x)>;
  Number twice = 0;
  for (std::size_t k = 2; k < count; ++k) {
    const auto &o = corner(0), &a = corner(k - 1), &b = corner(k);
    const Number ax = a.x - o.x, ay = a.y - o.y, bx = b.x - o.x, by = b.y - o.y;
    twice += ax * by - ay * bx;
  }
  return Number(twice / 2);
}

}  // namespace transillum
