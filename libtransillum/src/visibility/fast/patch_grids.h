// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Grids of patches, such as refinement makes of a face: found by the points that successive patches
// share, so that it does not matter who has divided the face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// Patches of one plane in columns and rows, counter-clockwise: columns to the right, rows upward.
/// Or a triangle in as many columns as rows, whose cells are divided by diagonals from the lower
/// right; it ends at the last diagonal.
struct PatchGrid {
  std::int32_t columns = 0, rows = 0;
  bool halves = false;           ///< this is a triangle
  std::vector<PointId> points;   ///< (columns + 1) a row, from below
  std::vector<PatchId> patches;  ///< row by row; in a triangle, two a cell

  PointId point(std::int32_t column, std::int32_t row) const {
    return points[static_cast<std::size_t>(row * (columns + 1) + column)];
  }
  /// @param half in a triangle, 0: below the diagonal of the cell; 1: above, or no_patch
  PatchId patch(std::int32_t column, std::int32_t row, std::int32_t half = 0) const {
    const std::int32_t cell = row * columns + column;
    return patches[static_cast<std::size_t>(halves ? 2 * cell + half : cell)];
  }
};

/// The grids of a scene with at least four patches; each patch is in one at most. Their columns,
/// rows and diagonals are straight but for rounding.
std::vector<PatchGrid> patch_grids(const Scene& scene);

}  // namespace transillum
