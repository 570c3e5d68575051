// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "visibility/plane/map_polygon.h"

namespace transillum {

/// An axis-parallel box of the plane.
struct PlaneBox {
  double x0, y0, x1, y1;

  friend bool operator==(const PlaneBox&, const PlaneBox&) = default;
  template <class Number>
  void add(const BasicPlanePoint<Number>& p) {
    const auto [x_low, x_high] = MapNumber<Number>::around(p.x);
    const auto [y_low, y_high] = MapNumber<Number>::around(p.y);
    *this = {std::min(x0, x_low), std::min(y0, y_low), std::max(x1, x_high), std::max(y1, y_high)};
  }
};

/// The box of a polygon, rounded outward, so that it is not empty even for a needle thinner than
/// the last place of a double.
template <class Number>
PlaneBox box_of(const std::vector<BasicMapCorner<Number>>& polygon) {
  PlaneBox box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const BasicMapCorner<Number>& corner : polygon) {
    box.add(corner.at);
  }
  const auto down = [](double x) { return std::nextafter(x, -HUGE_VAL); };
  const auto up = [](double x) { return std::nextafter(x, HUGE_VAL); };
  return {down(box.x0), down(box.y0), up(box.x1), up(box.y1)};
}

/// A spatial index of polygons: a loose quadtree over the plane.
///
/// A polygon is stored in one cell: on the finest level whose cells are no smaller than its box, in
/// the cell of its center. A cell's polygons thus reach at most half a cell beyond it. insert() and
/// erase() cost O(levels); query() skips empty subtrees, so a huge polygon over many small ones
/// costs in proportion to what it finds. Cells are created where polygons are, some levels finer
/// than an even distribution would require: a detailed house on a wide plain costs no more than the
/// house.
class PlaneIndex {
 public:
  /// @param all bounds of all polygons.
  /// @param expected approximate number of polygons at a time.
  PlaneIndex(const PlaneBox& all, std::size_t expected);

  void insert(std::int32_t id, const PlaneBox& box);
  void erase(std::int32_t id);
  /// Appends to `found` the ids whose boxes overlap `box`.
  void query(const PlaneBox& box, std::vector<std::int32_t>& found) const;

 private:
  static constexpr std::int32_t none = -1;
  struct Entry {
    PlaneBox box;
    std::int32_t cell;
    std::int32_t next, previous;
  };
  struct Cell {
    double x, y, size;
    std::int32_t parent;
    std::array<std::int32_t, 4> children{none, none, none, none};
    std::int32_t head = none;
    std::int32_t below = 0;  ///< number of entries in this cell and its descendants
  };
  std::int32_t child_toward(std::int32_t cell, double x, double y);
  void count(std::int32_t cell, std::int32_t change);

  int levels_;
  std::vector<Cell> cells_;  ///< the root first
  std::vector<Entry> entries_;
};

}  // namespace transillum
