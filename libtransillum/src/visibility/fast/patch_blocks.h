// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Patches that engine fast queries together: the cells of a face that is divided into rows and
// columns, or patches of one plane that follow each other as such cells do. Input: a scene; output:
// blocks of about four by four cells, and a scene that has one patch for each block.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// Patches of one plane in columns and rows, seen from their front side. Cell (0, 0) is at corner 0
/// of the outline; columns follow each other along its edge to corner 1.
struct PatchBlock {
  std::int32_t columns = 1, rows = 1;
  /// Where a diagonal from the lower right divides each cell in two: the number of strips between
  /// the diagonals that cross the block; else 1.
  std::int32_t strips = 1;
  std::uint32_t patches = 0;  ///< first in PatchBlocks::patches
  std::uint32_t lines = 0;    ///< first in PatchBlocks::lines

  bool has_halves() const { return strips > 1; }
  bool is_single() const { return columns == 1 && rows == 1 && strips == 1; }
  std::int32_t size() const { return columns * rows * (has_halves() ? 2 : 1); }
  /// Index of a patch, from `patches` on. A cell has strips column + row and column + row + 1.
  std::int32_t index(std::int32_t column, std::int32_t row, std::int32_t strip) const {
    const std::int32_t cell = row * columns + column;
    return has_halves() ? 2 * cell + strip - column - row : cell;
  }
};

/// All patches of a scene in blocks.
struct PatchBlocks {
  /// A line between columns, rows or strips, which begins and ends on edges of the block's outline:
  /// 0 to 1 along them. What comes before it lies left of it.
  struct Line {
    std::uint8_t from_edge, to_edge;
    double from, to;
  };

  std::shared_ptr<const Scene> scene;  ///< one patch per block, with the points of the scene
  std::vector<PatchBlock> blocks;      ///< per patch of `scene`
  std::vector<Line> lines;             ///< block by block: between columns, rows, strips
  std::vector<PatchId> patches;        ///< block by block; no_patch beside the block's outline
  std::vector<double> shares;          ///< for each of `patches`: its area over its block's

  /// Per block, the smallest of its shares.
  std::vector<double> smallest_shares() const;

  /// The blocks of a scene; null where they would not make passes faster.
  static std::shared_ptr<const PatchBlocks> of(const Scene& scene,
                                               const Cancellation& cancellation = {});
};

}  // namespace transillum
