// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/patch_grids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "transillum/at.h"

namespace transillum {
namespace {

/// Grids with fewer patches are not worth the division of what they see.
constexpr std::size_t smallest_grid = 4;
/// Largest distance of a point from the line and the plane of its grid, relative to the largest
/// coordinate, and to the width of a cell.
constexpr double straight = 0x1p-49, straight_cell = 1e-12;

class GridFinder {
 public:
  explicit GridFinder(const Scene& scene) : scene_(scene) {
    const Bounds& bounds = scene.bounds();
    limit_ = straight * std::max(max_abs(bounds.low), max_abs(bounds.high));
    std::vector<int> pieces(scene.patches().size(), 0);
    for (const Piece& piece : scene.pieces()) {
      ++at(pieces, piece.patch);
    }
    is_free_.resize(scene.patches().size());
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      at(is_free_, i) = static_cast<std::uint8_t>(at(pieces, i) == 1);
    }
  }

  std::vector<PatchGrid> find() {
    std::vector<PatchGrid> grids;
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      PatchGrid grid = largest_from(i);
      if (grid.patches.empty()) {
        continue;
      }
      for (const PatchId patch : grid.patches) {
        if (patch != no_patch) {
          at(is_free_, patch) = 0;
        }
      }
      grids.push_back(std::move(grid));
    }
    return grids;
  }

 private:
  enum class Kind : std::uint8_t { rectangle, triangle, reversed_triangle };

  /// The sides of a two-sided face alternate, and the outlines of its back are reversed.
  PatchGrid largest_from(PatchId i) {
    PatchGrid largest;
    for (const PatchId step : {1, 2}) {
      for (const Kind kind : {Kind::rectangle, Kind::triangle, Kind::reversed_triangle}) {
        PatchGrid grid = grid_from(i, step, kind);
        if (grid.patches.size() > largest.patches.size()) {
          largest = std::move(grid);
        }
      }
    }
    return largest;
  }
  /// Empty within rows that have been followed in vain: so that the time is linear.
  PatchGrid grid_from(PatchId i, PatchId step, Kind kind) {
    PatchId& tried = tried_[static_cast<std::size_t>(step - 1)][static_cast<std::size_t>(kind)];
    if (i < tried) {
      return {};
    }
    std::size_t followed = 0;
    PatchGrid grid = kind == Kind::rectangle
                         ? rectangle_from(i, step, followed)
                         : triangle_from(i, step, kind == Kind::reversed_triangle, followed);
    if (grid.patches.size() < smallest_grid || !is_straight(grid)) {
      grid = {};
      tried = i + static_cast<PatchId>(followed > 0 ? followed - 1 : 0) * step;
    }
    return grid;
  }

  bool is_cell(PatchId i, std::size_t corners) const {
    return i >= 0 && i < scene_.patch_count() && at(is_free_, i) != 0 &&
           scene_.outline(i).size() == corners;
  }
  bool have_one_normal(PatchId i, PatchId j) const {
    return norm(scene_.patch(i).normal - scene_.patch(j).normal) < 1e-9;
  }
  /// Whether q to r continues the line from p to q, but for rounding.
  bool continues(PointId p, PointId q, PointId r) const {
    const Vec3 before = scene_.point(q) - scene_.point(p),
               after = scene_.point(r) - scene_.point(q);
    return dot(before, after) > 0 && norm(cross(before, after)) <= 4 * limit_ * norm(before);
  }

  /// Whether patch j continues the row of patch i.
  bool is_next(PatchId i, PatchId j) const {
    if (!is_cell(j, 4) || !have_one_normal(i, j)) {
      return false;
    }
    const auto a = scene_.outline(i), b = scene_.outline(j);
    return a[1] == b[0] && a[2] == b[3] && continues(a[0], a[1], b[1]) &&
           continues(a[3], a[2], b[2]);
  }
  /// Whether patches from `next` on are a row beside the row from `first` on, whose corners `own`
  /// are their corners `other`.
  bool is_row(PatchId first, PatchId next, PatchId step, std::int32_t columns, std::size_t own,
              std::size_t other) const {
    for (std::int32_t c = 0; c < columns; ++c) {
      const PatchId i = first + c * step, j = next + c * step;
      if (!is_cell(j, 4) || !have_one_normal(i, j) || (c > 0 && !is_next(j - step, j))) {
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
  /// The quadrilaterals i, i + step, i + 2 step, ...; rows may follow upward or downward.
  /// @param followed is set to the number of patches in rows
  PatchGrid rectangle_from(PatchId i, PatchId step, std::size_t& followed) const {
    PatchGrid grid;
    if (!is_cell(i, 4)) {
      return grid;
    }
    grid.columns = grid.rows = 1;
    while (is_next(i + (grid.columns - 1) * step, i + grid.columns * step)) {
      ++grid.columns;
    }
    const PatchId to_next = grid.columns * step;
    const bool up = is_row(i, i + to_next, step, grid.columns, 3, 0);
    PatchId last = i;
    while (is_row(last, last + to_next, step, grid.columns, up ? 3 : 0, up ? 0 : 3)) {
      last += to_next;
      ++grid.rows;
    }
    followed = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
    const auto patch = [&](std::int32_t c, std::int32_t r) {
      return i + (up ? r : grid.rows - 1 - r) * to_next + c * step;
    };
    for (std::int32_t r = 0; r <= grid.rows; ++r) {
      for (std::int32_t c = 0; c <= grid.columns; ++c) {
        const bool right = c == grid.columns, top = r == grid.rows;
        const auto outline = scene_.outline(patch(right ? c - 1 : c, top ? r - 1 : r));
        grid.points.push_back(outline[top ? (right ? 2 : 3) : (right ? 1 : 0)]);
        if (!right && !top) {
          grid.patches.push_back(patch(c, r));
        }
      }
    }
    return grid;
  }

  /// One row of a triangle: lower and upper halves in turn, ending with a lower one.
  struct TriangleRow {
    std::vector<PatchId> patches;
    std::vector<PointId> below, above;
  };
  TriangleRow row_from(PatchId i, PatchId step, bool reversed) const {
    TriangleRow row;
    const auto corner = [&](PatchId patch, std::size_t k) {
      return scene_.outline(patch)[reversed ? 2 - k : k];
    };
    if (!is_cell(i, 3)) {
      return row;
    }
    row.patches.push_back(i);
    row.below = {corner(i, 0), corner(i, 1)};
    row.above = {corner(i, 2)};
    for (PatchId half = i + step, next = half + step;; half += 2 * step, next += 2 * step) {
      if (!is_cell(half, 3) || !is_cell(next, 3) || !have_one_normal(i, half) ||
          !have_one_normal(i, next) || corner(half, 0) != row.below.back() ||
          corner(half, 2) != row.above.back() || corner(next, 0) != row.below.back() ||
          corner(next, 2) != corner(half, 1)) {
        return row;
      }
      row.patches.insert(row.patches.end(), {half, next});
      row.above.push_back(corner(half, 1));
      row.below.push_back(corner(next, 1));
    }
  }
  /// The triangles i, i + step, i + 2 step, ...
  /// @param followed is set to the number of patches in rows
  PatchGrid triangle_from(PatchId i, PatchId step, bool reversed, std::size_t& followed) const {
    std::vector<TriangleRow> rows{row_from(i, step, reversed)};
    followed = rows[0].patches.size();
    const std::size_t count = rows[0].above.size();
    for (PatchId next = i; rows.size() < count;) {
      next += static_cast<PatchId>(rows.back().patches.size()) * step;
      rows.push_back(row_from(next, step, reversed));
      const TriangleRow &row = rows.back(), &before = rows[rows.size() - 2];
      if (row.patches.empty() || row.below != before.above || !have_one_normal(i, row.patches[0])) {
        return {};
      }
      followed += row.patches.size();
    }
    PatchGrid grid;
    if (count < 2) {
      return grid;
    }
    const auto n = static_cast<std::int32_t>(count);
    grid.columns = grid.rows = n;
    grid.halves = true;
    grid.points.assign((count + 1) * (count + 1), rows[0].below[0]);
    grid.patches.assign(2 * count * count, no_patch);
    // Seen from behind, columns are rows.
    const auto cell = [&](std::int32_t c, std::int32_t r, std::int32_t across) {
      return static_cast<std::size_t>(reversed ? c * across + r : r * across + c);
    };
    for (std::int32_t r = 0; r < n; ++r) {
      const TriangleRow& row = rows[static_cast<std::size_t>(r)];
      for (std::int32_t c = 0; c <= n - r; ++c) {
        grid.points[cell(c, r, n + 1)] = row.below[static_cast<std::size_t>(c)];
      }
      for (std::size_t k = 0; k < row.patches.size(); ++k) {
        grid.patches[2 * cell(static_cast<std::int32_t>(k / 2), r, n) + k % 2] = row.patches[k];
      }
    }
    grid.points[cell(0, n, n + 1)] = rows.back().above[0];
    return grid;
  }

  /// Whether the points of each column, row and diagonal follow each other on a line, in one plane,
  /// but for rounding.
  bool is_straight(const PatchGrid& grid) const {
    bool all = true;
    // The normal of a small patch is less accurate.
    const Vec3 origin = scene_.point(grid.point(0, 0));
    const Vec3 normal = normalized(cross(scene_.point(grid.point(grid.columns, 0)) - origin,
                                         scene_.point(grid.point(0, grid.rows)) - origin));
    for (const PointId p : grid.points) {
      all = all && std::abs(dot(normal, scene_.point(p) - origin)) <= 2 * limit_;
    }
    const auto length = [&](std::int32_t whole, std::int32_t k) {
      return grid.halves ? grid.columns - k : whole;
    };
    for (std::int32_t c = 0; c <= grid.columns; ++c) {
      all = all &&
            are_in_line(length(grid.rows, c), [&](std::int32_t r) { return grid.point(c, r); });
    }
    for (std::int32_t r = 0; r <= grid.rows; ++r) {
      all = all &&
            are_in_line(length(grid.columns, r), [&](std::int32_t c) { return grid.point(c, r); });
    }
    for (std::int32_t d = 1; grid.halves && d <= grid.columns; ++d) {
      all = all && are_in_line(d, [&](std::int32_t r) { return grid.point(d - r, r); });
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
      const double off_line = norm(cross(along, p - start)) / norm(along);
      if (!(dot(p - before, along) > 0) || off_line > limit_ ||
          off_line > straight_cell * norm(p - before)) {
        return false;
      }
      before = p;
    }
    return true;
  }

  const Scene& scene_;
  double limit_ = 0;
  std::array<std::array<PatchId, 3>, 2> tried_{};  ///< by step and kind: where to begin again
  std::vector<std::uint8_t> is_free_;              ///< by patch: convex and in no grid
};

}  // namespace

std::vector<PatchGrid> patch_grids(const Scene& scene) { return GridFinder(scene).find(); }

}  // namespace transillum
