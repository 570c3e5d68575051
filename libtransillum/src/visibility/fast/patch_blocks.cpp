// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/patch_blocks.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "scene/build/division.h"
#include "transillum/at.h"
#include "visibility/bsp/coplanar_overlap.h"
#include "visibility/fast/patch_grids.h"

namespace transillum {
namespace {

/// Columns and rows of a block, one more at most: what a query resolves is relative to the size of
/// its fragment.
constexpr std::int32_t block_width = 4;

/// A point of a grid: between columns and between rows.
struct GridPlace {
  std::int32_t column, row;
};

/// A part of a grid, or a patch that is in none.
struct Block {
  const PatchGrid* grid = nullptr;  ///< null: `smallest_patch` as it is
  PatchId smallest_patch = no_patch;
  std::int32_t column = 0, row = 0, columns = 1, rows = 1;  ///< in the grid

  /// In the order of PatchBlock::index(), without those that the grid does not have.
  template <class Visit>
  void for_each_patch(Visit visit) const {
    if (grid == nullptr) {
      visit(smallest_patch);
      return;
    }
    for (std::int32_t r = row; r < row + rows; ++r) {
      for (std::int32_t c = column; c < column + columns; ++c) {
        for (std::int32_t half = 0; half < (grid->halves ? 2 : 1); ++half) {
          if (grid->patch(c, r, half) != no_patch) {
            visit(grid->patch(c, r, half));
          }
        }
      }
    }
  }
  /// Columns plus rows of the last diagonal that the block reaches, from its cell (0, 0).
  std::int32_t strips() const {
    return grid->halves ? std::min(columns + rows, grid->columns - column - row) : 1;
  }
  /// The corners of its outline: a rectangle, without what lies beyond the last diagonal.
  std::vector<GridPlace> outline() const {
    const std::int32_t right = column + columns, top = row + rows;
    std::vector<GridPlace> places{{column, row}, {right, row}};
    if (grid->halves && right + top > grid->columns) {
      places.push_back({right, grid->columns - right});
      places.push_back({grid->columns - top, top});
    } else {
      places.push_back({right, top});
    }
    places.push_back({column, top});
    std::vector<GridPlace> corners;
    for (const GridPlace& p : places) {
      const bool again =
          !corners.empty() && ((p.column == corners.back().column && p.row == corners.back().row) ||
                               (p.column == column && p.row == row));
      if (!again) {
        corners.push_back(p);
      }
    }
    return corners;
  }
};

/// Where to cut an edge of n cells into blocks, with both ends. The same from both ends, so that
/// faces that share the edge are cut in the same points.
std::vector<std::int32_t> cuts_of(std::int32_t n) {
  std::int32_t parts = std::max(1, (n + block_width / 2) / block_width);
  parts += n % 2 == 1 && parts % 2 == 0 ? 1 : 0;
  std::vector<std::int32_t> cuts;
  const auto place = [&](std::int32_t k) {
    return static_cast<std::int32_t>(std::int64_t{k} * n / parts);
  };
  for (std::int32_t k = 0; k <= parts; ++k) {
    cuts.push_back(2 * k <= parts ? place(k) : n - place(parts - k));
  }
  return cuts;
}

/// The parts of a grid that are no larger than a block.
void add_blocks(const PatchGrid& grid, std::vector<Block>& blocks) {
  const std::vector<std::int32_t> across = cuts_of(grid.columns), up = cuts_of(grid.rows);
  for (std::size_t y = 0; y + 1 < up.size(); ++y) {
    for (std::size_t x = 0; x + 1 < across.size(); ++x) {
      const std::int32_t c = across[x], r = up[y];
      std::int32_t columns = across[x + 1] - c, rows = up[y + 1] - r;
      if (grid.halves) {
        columns = std::min(columns, grid.columns - c - r);
        rows = std::min(rows, grid.columns - c - r);
      }
      if (columns > 0) {
        Block block{&grid, std::numeric_limits<PatchId>::max(), c, r, columns, rows};
        block.for_each_patch(
            [&](PatchId i) { block.smallest_patch = std::min(block.smallest_patch, i); });
        blocks.push_back(block);
      }
    }
  }
}

/// Makes PatchBlocks of blocks.
class BlockBuilder {
 public:
  BlockBuilder(const Scene& scene, const Cancellation& cancellation)
      : scene_(scene), cancellation_(cancellation), grids_(patch_grids(scene)) {
    for (const PatchGrid& grid : grids_) {
      add_blocks(grid, blocks_);
    }
    std::vector<bool> in_block(scene.patches().size(), false);
    for (const Block& block : blocks_) {
      block.for_each_patch([&](PatchId i) { in_block[static_cast<std::size_t>(i)] = true; });
    }
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      if (!in_block[static_cast<std::size_t>(i)]) {
        blocks_.push_back({nullptr, i});
      }
    }
    sort();
  }

  bool pay() const { return 2 * blocks_.size() <= scene_.patches().size(); }

  std::shared_ptr<const Scene> united() const {
    std::vector<UnitedPatch> patches;
    for (const Block& block : blocks_) {
      UnitedPatch& patch = patches.emplace_back();
      patch.like = block.smallest_patch;
      if (block.grid != nullptr) {
        for (const GridPlace& corner : block.outline()) {
          patch.outline.push_back(block.grid->point(corner.column, corner.row));
        }
      }
    }
    return with_united(scene_, patches, cancellation_);
  }

  /// Replaces blocks by their patches.
  void dissolve(const std::vector<bool>& chosen) {
    std::vector<Block> kept;
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      if (chosen[k]) {
        blocks_[k].for_each_patch([&](PatchId i) { kept.push_back({nullptr, i}); });
      } else {
        kept.push_back(blocks_[k]);
      }
    }
    blocks_ = std::move(kept);
    sort();
  }

  std::shared_ptr<const PatchBlocks> build(std::shared_ptr<const Scene> united) {
    const auto built = std::make_shared<PatchBlocks>();
    built->scene = std::move(united);
    for (const Block& block : blocks_) {
      PatchBlock& made = built->blocks.emplace_back();
      made.patches = static_cast<std::uint32_t>(built->patches.size());
      made.lines = static_cast<std::uint32_t>(built->lines.size());
      if (block.grid == nullptr) {
        built->patches.push_back(block.smallest_patch);
        built->shares.push_back(1);
        continue;
      }
      made.columns = block.columns;
      made.rows = block.rows;
      made.strips = block.strips();
      add_patches(block, *built);
      add_lines(block, built->lines);
    }
    return built;
  }

 private:
  /// In the order of their patches, so that the two sides of a face stay together.
  void sort() {
    std::stable_sort(blocks_.begin(), blocks_.end(), [](const Block& a, const Block& b) {
      return a.smallest_patch < b.smallest_patch;
    });
  }

  void add_patches(const Block& block, PatchBlocks& built) const {
    double sum = 0;
    const std::size_t first = built.patches.size();
    for (std::int32_t r = block.row; r < block.row + block.rows; ++r) {
      for (std::int32_t c = block.column; c < block.column + block.columns; ++c) {
        for (std::int32_t half = 0; half < (block.grid->halves ? 2 : 1); ++half) {
          const PatchId i = block.grid->patch(c, r, half);
          built.patches.push_back(i);
          built.shares.push_back(i == no_patch ? 0 : scene_.patch(i).area);
          sum += built.shares.back();
        }
      }
    }
    for (std::size_t k = first; k < built.shares.size(); ++k) {
      built.shares[k] /= sum;
    }
  }

  void add_lines(const Block& block, std::vector<PatchBlocks::Line>& lines) const {
    const std::vector<GridPlace> outline = block.outline();
    const std::int32_t left = block.column, low = block.row;
    const std::int32_t right = left + block.columns, top = low + block.rows;
    const std::int32_t last = block.grid->halves ? block.grid->columns : right + top;
    const auto add = [&](const GridPlace& from, const GridPlace& to) {
      const OnEdge a = on_edge(block, outline, from), b = on_edge(block, outline, to);
      lines.push_back({a.edge, b.edge, a.t, b.t});
    };
    for (std::int32_t c = left + 1; c < right; ++c) {
      add({c, low}, {c, std::min(top, last - c)});
    }
    for (std::int32_t r = low + 1; r < top; ++r) {
      add({std::min(right, last - r), r}, {left, r});
    }
    for (std::int32_t k = 1; k < block.strips(); ++k) {
      const std::int32_t d = left + low + k;
      add(d - low <= right ? GridPlace{d - low, low} : GridPlace{right, d - right},
          d - left <= top ? GridPlace{left, d - left} : GridPlace{d - top, top});
    }
  }

  struct OnEdge {
    std::uint8_t edge;
    double t;
  };
  /// The edge of a block's outline on which a point of its grid lies, and where.
  OnEdge on_edge(const Block& block, const std::vector<GridPlace>& outline,
                 const GridPlace& place) const {
    const auto position = [&](const GridPlace& p) {
      return scene_.point(block.grid->point(p.column, p.row));
    };
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const GridPlace &a = outline[k], &b = outline[(k + 1) % outline.size()];
      const std::int32_t dx = b.column - a.column, dy = b.row - a.row;
      const std::int32_t px = place.column - a.column, py = place.row - a.row;
      const std::int32_t along = dx * px + dy * py;
      if (dx * py == dy * px && along >= 0 && along <= dx * dx + dy * dy) {
        return {static_cast<std::uint8_t>(k),
                norm(position(place) - position(a)) / norm(position(b) - position(a))};
      }
    }
    throw std::logic_error("a line of a block ends on its outline");
  }

  const Scene& scene_;
  const Cancellation& cancellation_;
  std::vector<PatchGrid> grids_;
  std::vector<Block> blocks_;
};

}  // namespace

std::vector<double> PatchBlocks::smallest_shares() const {
  std::vector<double> smallest;
  for (const PatchBlock& block : blocks) {
    double least = 1;
    for (std::int32_t k = 0; k < block.size(); ++k) {
      const double share = shares[block.patches + static_cast<std::size_t>(k)];
      least = share > 0 ? std::min(least, share) : least;
    }
    smallest.push_back(least);
  }
  return smallest;
}

std::shared_ptr<const PatchBlocks> PatchBlocks::of(const Scene& scene,
                                                   const Cancellation& cancellation) {
  BlockBuilder builder(scene, cancellation);
  if (!builder.pay()) {
    return nullptr;
  }
  auto united = builder.united();
  // Where faces of one plane overlap, the smaller patch covers the larger one.
  const std::size_t most = scene.patches().size();
  const auto overlaps = coplanar_overlaps(*united, most, cancellation);
  if (overlaps.size() >= most) {
    return nullptr;
  }
  if (!overlaps.empty()) {
    std::vector<bool> overlapping(united->patches().size(), false);
    for (const CoplanarOverlap& overlap : overlaps) {
      overlapping[static_cast<std::size_t>(overlap.upper)] = true;
      overlapping[static_cast<std::size_t>(overlap.lower)] = true;
    }
    builder.dissolve(overlapping);
    if (!builder.pay()) {
      return nullptr;
    }
    united = builder.united();
  }
  return builder.build(std::move(united));
}

}  // namespace transillum
