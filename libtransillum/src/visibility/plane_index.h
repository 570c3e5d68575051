// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "visibility/map_polygon.h"

namespace transillum {

/// An axis-parallel box of the plane.
struct PlaneBox {
  double x0, y0, x1, y1;
};
PlaneBox box_of(const MapPolygon& polygon);

/// Which polygons may overlap a box: a loose quadtree over the plane, each level a full grid.
///
/// A polygon hangs in one cell: on the finest level whose cells are no smaller than its box, in
/// the cell of its centre. A cell's polygons thus stay within half a cell around it. Putting in
/// and taking out cost O(levels); asking skips empty subtrees, so one huge polygon over many
/// small ones costs what it finds.
class PlaneIndex {
 public:
  /// Covers `all`; made for about `expected` polygons at a time.
  PlaneIndex(const PlaneBox& all, std::size_t expected);

  void insert(std::int32_t id, const PlaneBox& box);
  void erase(std::int32_t id);
  /// Appends to `found` the ids whose boxes overlap `box`.
  void query(const PlaneBox& box, std::vector<std::int32_t>& found) const;

 private:
  struct Entry {
    PlaneBox box;
    std::int32_t level, x, y;
    std::int32_t next, previous;
  };
  struct Cell {
    std::int32_t head = -1;
    std::int32_t below = 0;  ///< entries here and in all cells beneath
  };
  Cell& cell(int level, int x, int y);
  const Cell& cell(int level, int x, int y) const;
  void count(const Entry& entry, std::int32_t change);

  double x0_, y0_, size_;
  int levels_;
  std::vector<std::size_t> level_begin_;
  std::vector<double> cell_size_;  ///< a level
  std::vector<Cell> cells_;
  std::vector<Entry> entries_;
};

}  // namespace transillum
