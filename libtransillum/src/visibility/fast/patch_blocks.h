// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Patches that engine fast queries together: the cells of a face that is divided into rows and
// columns, or quadrilaterals of one plane that follow each other as such cells do. Input: a scene;
// output: blocks of up to eight by eight of its patches, and a scene that has one patch for each
// block.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// Patches of one plane in columns and rows, seen from their front side.
struct PatchBlock {
  PatchId first = no_patch;            ///< in column 0 of row 0
  PatchId column_step = 0;             ///< to the patch in the next column
  PatchId row_step = 0;                ///< to the patch in the next row
  std::int32_t columns = 1, rows = 1;  ///< 1 and 1: a patch of any shape
  std::uint32_t lines = 0;             ///< first of its lines in PatchBlocks::lines
  std::uint32_t shares = 0;            ///< first of its patches in PatchBlocks::shares

  bool is_single() const { return columns == 1 && rows == 1; }
  PatchId patch(std::int32_t column, std::int32_t row) const {
    return first + column * column_step + row * row_step;
  }
};

/// All patches of a scene in blocks.
struct PatchBlocks {
  /// Where a line between columns begins on edge 0-1 of its block's outline and ends on edge 3-2,
  /// or one between rows begins on edge 1-2 and ends on edge 0-3: 0 to 1, along these edges.
  /// Columns and rows before it lie left of it.
  struct Line {
    double from, to;
  };

  std::shared_ptr<const Scene> scene;  ///< one patch per block, with the points of the scene
  std::vector<PatchBlock> blocks;      ///< per patch of `scene`
  std::vector<Line> lines;             ///< block by block: between columns, then rows
  std::vector<double> shares;          ///< area of each patch over its block's, row by row

  /// Per block, the smallest of its shares.
  std::vector<double> smallest_shares() const;

  /// The blocks of a scene; null where they would not make passes faster.
  static std::shared_ptr<const PatchBlocks> of(const Scene& scene,
                                               const Cancellation& cancellation = {});
};

}  // namespace transillum
