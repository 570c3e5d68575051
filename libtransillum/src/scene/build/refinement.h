// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Refinement of large faces into grids of smaller patches (SceneOptions::max_patch_area).

#include <vector>

#include "scene/build/point_table.h"

namespace transillum {

/// A regular subdivision of a triangle or a convex quadrilateral into cells.
struct CellGrid {
  std::vector<PointId> outline;  ///< three or four corners
  int columns = 1;               ///< divisions of edge 0-1; of every edge of a triangle
  int rows = 1;                  ///< divisions of edge 1-2; 1 for a triangle

  std::int64_t cell_count() const {
    return static_cast<std::int64_t>(columns) * (outline.size() == 3 ? columns : rows);
  }
};

/// The coarsest grid whose cells are no larger than `max_area` (m²): nearly square cells in a
/// quadrilateral, similar triangles in a triangle.
CellGrid choose_grid(const std::vector<Vec3>& points, std::vector<PointId> outline, double area,
                     double max_area);

/// The outlines of the cells, row by row. New points are added to `table`; those on an edge depend
/// only on its end points and number of divisions, so adjacent faces share them bit for bit.
std::vector<std::vector<PointId>> make_cells(PointTable& table, const CellGrid& grid);

}  // namespace transillum
