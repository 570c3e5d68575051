// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Grids are found by the points that patches share, so that it does not matter who has divided a
// face: successive patches that share an edge are a row, successive rows that share edges a grid.
#include "visibility/fast/patch_blocks.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "scene/build/division.h"
#include "transillum/at.h"
#include "visibility/bsp/coplanar_overlap.h"

namespace transillum {
namespace {

/// Most columns and rows of a block: what a query resolves is relative to the size of its fragment.
constexpr std::int32_t largest_block = 4;
/// Grids with fewer patches are not worth the division of what they see.
constexpr std::int32_t smallest_grid = 4;
/// Largest distance of a point from the line of its grid, relative to the largest coordinate.
constexpr double straight = 0x1p-49;

class BlockFinder {
 public:
  explicit BlockFinder(const Scene& scene) : scene_(scene) {
    const Bounds& bounds = scene.bounds();
    limit_ = straight * std::max(max_abs(bounds.low), max_abs(bounds.high));
    is_cell_.assign(scene.patches().size(), 0);
    std::vector<int> pieces(scene.patches().size(), 0);
    for (const Piece& piece : scene.pieces()) {
      ++at(pieces, piece.patch);
      at(is_cell_, piece.patch) = static_cast<std::uint8_t>(scene.corners(piece).size() == 4 &&
                                                            scene.outline(piece.patch).size() == 4);
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      is_cell_[i] = static_cast<std::uint8_t>(is_cell_[i] != 0 && pieces[i] == 1);
    }
    taken_.assign(scene.patches().size(), 0);
  }

  /// Grids of at least smallest_grid patches, without lines.
  std::vector<PatchBlock> find_grids() {
    std::vector<PatchBlock> grids;
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (at(taken_, i) != 0) {
        continue;
      }
      const PatchBlock grid = grid_from(i);
      if (grid.columns * grid.rows < smallest_grid || !is_straight(grid)) {
        continue;
      }
      for (std::int32_t r = 0; r < grid.rows; ++r) {
        for (std::int32_t c = 0; c < grid.columns; ++c) {
          at(taken_, grid.patch(c, r)) = 1;
        }
      }
      grids.push_back(grid);
    }
    return grids;
  }

  void add_lines(PatchBlock& block, std::vector<PatchBlocks::Line>& lines) const {
    block.lines = static_cast<std::uint32_t>(lines.size());
    const std::int32_t columns = block.columns, rows = block.rows;
    const auto length = [&](PointId a, PointId b) {
      return norm(scene_.point(b) - scene_.point(a));
    };
    const auto row = [&](std::int32_t c, std::int32_t r) {
      return length(point(block, 0, r), point(block, c, r));
    };
    const auto column = [&](std::int32_t c, std::int32_t r) {
      return length(point(block, c, 0), point(block, c, r));
    };
    for (std::int32_t c = 1; c < columns; ++c) {
      lines.push_back({row(c, 0) / row(columns, 0), row(c, rows) / row(columns, rows)});
    }
    for (std::int32_t r = 1; r < rows; ++r) {
      lines.push_back({column(columns, r) / column(columns, rows), column(0, r) / column(0, rows)});
    }
  }
  void add_shares(PatchBlock& block, std::vector<double>& shares) const {
    block.shares = static_cast<std::uint32_t>(shares.size());
    double sum = 0;
    for (std::int32_t r = 0; r < block.rows; ++r) {
      for (std::int32_t c = 0; c < block.columns; ++c) {
        shares.push_back(scene_.patch(block.patch(c, r)).area);
        sum += shares.back();
      }
    }
    std::for_each(shares.begin() + block.shares, shares.end(), [&](double& area) { area /= sum; });
  }

  /// The point between columns c - 1 and c, and rows r - 1 and r.
  PointId point(const PatchBlock& grid, std::int32_t c, std::int32_t r) const {
    const bool right = c == grid.columns, top = r == grid.rows;
    const auto outline = scene_.outline(grid.patch(right ? c - 1 : c, top ? r - 1 : r));
    return outline[top ? (right ? 2 : 3) : (right ? 1 : 0)];
  }

 private:
  bool is_free_cell(PatchId i) const {
    return i >= 0 && i < scene_.patch_count() && at(is_cell_, i) != 0 && at(taken_, i) == 0;
  }
  bool have_one_normal(PatchId i, PatchId j) const {
    return norm(scene_.patch(i).normal - scene_.patch(j).normal) < 1e-12;
  }
  /// Whether patch j continues the row of patch i.
  bool is_next(PatchId i, PatchId j) const {
    if (!is_free_cell(j) || !have_one_normal(i, j)) {
      return false;
    }
    const auto a = scene_.outline(i), b = scene_.outline(j);
    return a[1] == b[0] && a[2] == b[3] && continues(a[0], a[1], b[1]) &&
           continues(a[3], a[2], b[2]);
  }
  /// Whether q to r continues the line from p to q, but for rounding.
  bool continues(PointId p, PointId q, PointId r) const {
    const Vec3 before = scene_.point(q) - scene_.point(p),
               after = scene_.point(r) - scene_.point(q);
    return dot(before, after) > 0 && norm(cross(before, after)) <= 4 * limit_ * norm(before);
  }

  /// The grid of patches i, i + step, i + 2 step, ...
  PatchBlock grid_from(PatchId i, PatchId step) const {
    PatchBlock grid{i, step, 0};
    if (!is_free_cell(i)) {
      return grid;
    }
    while (is_next(grid.patch(grid.columns - 1, 0), grid.patch(grid.columns, 0))) {
      ++grid.columns;
    }
    const PatchId to_next = grid.columns * step;
    const bool up = is_row(grid, i, i + to_next, 3, 0);
    PatchId last = i;
    while (is_row(grid, last, last + to_next, up ? 3 : 0, up ? 0 : 3)) {
      last += to_next;
      ++grid.rows;
    }
    grid.first = up ? i : last;
    grid.row_step = up ? to_next : -to_next;
    return grid;
  }
  /// The larger one of the grids that begin with patch i: the two sides of a face may alternate.
  PatchBlock grid_from(PatchId i) const {
    const PatchBlock one = grid_from(i, 1), two = grid_from(i, 2);
    return one.columns * one.rows >= two.columns * two.rows ? one : two;
  }
  /// Whether a row from patch `next` lies beside the row from patch `first`, whose corner `own`
  /// it shares as its corner `other`.
  bool is_row(const PatchBlock& grid, PatchId first, PatchId next, std::size_t own,
              std::size_t other) const {
    for (std::int32_t c = 0; c < grid.columns; ++c) {
      const PatchId i = first + c * grid.column_step, j = next + c * grid.column_step;
      if (!is_free_cell(j) || !have_one_normal(i, j) ||
          (c > 0 && !is_next(j - grid.column_step, j))) {
        return false;
      }
      const auto a = scene_.outline(i), b = scene_.outline(j);
      // Corners 3 and 2 are above 0 and 1.
      if (a[own] != b[other] || a[own ^ 1] != b[other ^ 1] ||
          !continues(a[other], a[own], b[own]) ||
          !continues(a[other ^ 1], a[own ^ 1], b[own ^ 1])) {
        return false;
      }
    }
    return true;
  }

  /// Whether the points of each column and row follow each other on a line, but for rounding.
  bool is_straight(const PatchBlock& grid) const {
    bool all = true;
    for (std::int32_t c = 0; c <= grid.columns; ++c) {
      all = all && are_in_line(grid.rows, [&](std::int32_t r) { return point(grid, c, r); });
    }
    for (std::int32_t r = 0; r <= grid.rows; ++r) {
      all = all && are_in_line(grid.columns, [&](std::int32_t c) { return point(grid, c, r); });
    }
    return all;
  }
  template <class PointAt>
  bool are_in_line(std::int32_t steps, PointAt at_step) const {
    const Vec3 start = scene_.point(at_step(0));
    const Vec3 along = scene_.point(at_step(steps)) - start;
    Vec3 before = start;
    for (std::int32_t k = 1; k <= steps; ++k) {
      const Vec3 p = scene_.point(at_step(k));
      if (!(dot(p - before, along) > 0) || norm(cross(along, p - start)) > limit_ * norm(along)) {
        return false;
      }
      before = p;
    }
    return true;
  }

  const Scene& scene_;
  double limit_ = 0;
  std::vector<std::uint8_t> is_cell_, taken_;
};

/// The parts of a grid that are no larger than a block.
void add_blocks(const PatchBlock& grid, std::vector<PatchBlock>& blocks) {
  const auto parts = [](std::int32_t n) { return (n + largest_block - 1) / largest_block; };
  const std::int32_t across = parts(grid.columns), up = parts(grid.rows);
  for (std::int32_t y = 0; y < up; ++y) {
    for (std::int32_t x = 0; x < across; ++x) {
      const std::int32_t c = x * grid.columns / across, r = y * grid.rows / up;
      PatchBlock block = grid;
      block.first = grid.patch(c, r);
      block.columns = (x + 1) * grid.columns / across - c;
      block.rows = (y + 1) * grid.rows / up - r;
      blocks.push_back(block);
    }
  }
}

PatchId smallest_patch(const PatchBlock& block) {
  return std::min(block.patch(0, 0), block.patch(0, block.rows - 1));
}

/// Replaces blocks by their patches.
void dissolve(const std::vector<bool>& chosen, std::vector<PatchBlock>& blocks) {
  std::vector<PatchBlock> kept;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (!chosen[k]) {
      kept.push_back(blocks[k]);
      continue;
    }
    for (std::int32_t r = 0; r < blocks[k].rows; ++r) {
      for (std::int32_t c = 0; c < blocks[k].columns; ++c) {
        kept.push_back({blocks[k].patch(c, r)});
      }
    }
  }
  blocks = std::move(kept);
}

void add_single_patches(const Scene& scene, std::vector<PatchBlock>& blocks) {
  std::vector<bool> in_block(scene.patches().size(), false);
  for (const PatchBlock& block : blocks) {
    for (std::int32_t r = 0; r < block.rows; ++r) {
      for (std::int32_t c = 0; c < block.columns; ++c) {
        in_block[static_cast<std::size_t>(block.patch(c, r))] = true;
      }
    }
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (!in_block[static_cast<std::size_t>(i)]) {
      blocks.push_back({i});
    }
  }
}

}  // namespace

std::vector<double> PatchBlocks::smallest_shares() const {
  std::vector<double> smallest;
  for (const PatchBlock& block : blocks) {
    const auto first = shares.begin() + block.shares;
    smallest.push_back(*std::min_element(first, first + block.columns * block.rows));
  }
  return smallest;
}

std::shared_ptr<const PatchBlocks> PatchBlocks::of(const Scene& scene,
                                                   const Cancellation& cancellation) {
  BlockFinder finder(scene);
  auto found = std::make_shared<PatchBlocks>();
  for (const PatchBlock& grid : finder.find_grids()) {
    add_blocks(grid, found->blocks);
  }
  add_single_patches(scene, found->blocks);
  if (found->blocks.size() > scene.patches().size() / 2) {
    return nullptr;
  }
  const auto unite = [&] {
    // In the order of their patches, so that the two sides of a face stay together.
    std::sort(found->blocks.begin(), found->blocks.end(),
              [](const PatchBlock& a, const PatchBlock& b) {
                return smallest_patch(a) < smallest_patch(b);
              });
    std::vector<UnitedPatch> united;
    for (const PatchBlock& block : found->blocks) {
      UnitedPatch& patch = united.emplace_back();
      patch.like = block.first;
      if (!block.is_single()) {
        patch.outline = {finder.point(block, 0, 0), finder.point(block, block.columns, 0),
                         finder.point(block, block.columns, block.rows),
                         finder.point(block, 0, block.rows)};
      }
    }
    found->scene = with_united(scene, united, cancellation);
  };
  unite();
  // Where faces of one plane overlap, the smaller patch covers the larger one.
  const auto overlaps =
      coplanar_overlaps(*found->scene, std::numeric_limits<std::size_t>::max(), cancellation);
  if (!overlaps.empty()) {
    std::vector<bool> overlapping(found->blocks.size(), false);
    for (const CoplanarOverlap& overlap : overlaps) {
      overlapping[static_cast<std::size_t>(overlap.upper)] = true;
      overlapping[static_cast<std::size_t>(overlap.lower)] = true;
    }
    dissolve(overlapping, found->blocks);
    if (found->blocks.size() > scene.patches().size() / 2) {
      return nullptr;
    }
    unite();
  }
  for (PatchBlock& block : found->blocks) {
    finder.add_lines(block, found->lines);
    finder.add_shares(block, found->shares);
  }
  return found;
}

}  // namespace transillum
