// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/fast/block_overlay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transillum/at.h"

namespace transillum {
namespace {

/// A block farther than this from the origin of a frame, relative to the one that is divided, gets
/// lines from wide numbers: they pass near the other one.
constexpr double most_far = 16;
/// A block is narrow if its perimeter over its area, 1 over grid units, is at least this.
constexpr double narrow = 0x1p-45;

}  // namespace

void BlockOverlay::begin(const NeedleFrame& frame, const ProjectedFragments::Fragment& own,
                         const ProjectedFragments::Fragment& other, bool keep_segments) {
  keep_segments_ = keep_segments;
  cells_.clear();
  kept_.clear();
  pool_.clear();
  if (own_ == nullptr) {
    own_ = &at(blocks_.blocks, own.patch);
    own_far_ = 0;
    for (std::uint32_t k = own.begin; k < own.end; ++k) {
      const GridPoint& p = projected_.corners[k];
      own_far_ = std::max({own_far_, std::abs(static_cast<double>(p.x - frame.origin.x)),
                           std::abs(static_cast<double>(p.y - frame.origin.y))});
    }
    lines_.clear();
    add_axes(frame, own, 0);
    own_lines_ = lines_.size();
  }
  other_ = &at(blocks_.blocks, other.patch);
  lines_.resize(own_lines_);
  add_axes(frame, other, 3);
}

bool BlockOverlay::is_narrow(PatchId block) const {
  const auto outline = blocks_.scene->outline(block);
  const GridPoint& apex = at(projected_.grid.points, outline[0]);
  double perimeter = 0;
  long double twice_area = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const GridPoint& p = at(projected_.grid.points, outline[k]);
    const GridPoint& q = at(projected_.grid.points, outline[k + 1 < outline.size() ? k + 1 : 0]);
    perimeter += static_cast<double>(std::abs(q.x - p.x) + std::abs(q.y - p.y));
    twice_area += static_cast<long double>(p.x - apex.x) * static_cast<long double>(q.y - apex.y) -
                  static_cast<long double>(p.y - apex.y) * static_cast<long double>(q.x - apex.x);
  }
  // Corners are rounded to the grid, and coordinates to doubles.
  const Bounds& bounds = blocks_.scene->bounds();
  const double coordinates = std::max(max_abs(bounds.low), max_abs(bounds.high));
  const double rounding = std::max(1.0, 0x1p-53 * coordinates / projected_.grid.unit);
  return perimeter * rounding >= narrow * std::abs(static_cast<double>(twice_area / 2));
}

std::span<const BlockOverlay::Cell> BlockOverlay::divide_outline(
    const ProjectedFragments::Fragment& fragment) {
  const std::size_t count = fragment.end - fragment.begin;
  const auto corners =
      std::span<const GridPoint>(projected_.corners).subspan(fragment.begin, count);
  const NeedleFrame frame = NeedleFrame::around(corners);
  begin_query();
  begin(frame, fragment, fragment, false);
  axes_[3] = axes_[4] = axes_[5] = {};
  for (std::size_t k = 0; k < count; ++k) {
    const NeedleFrame::Point p = frame.map({corners[k]}), q = frame.map({corners[(k + 1) % count]});
    pool_.push_back({p.x, p.y, q.x, q.y});
  }
  finish();
  return cells_;
}

/// Adds the lines of a block. Their ends are found between its corners, so that columns and rows
/// have their shares even where the grid of the plane is coarse beside their width.
void BlockOverlay::add_axes(const NeedleFrame& frame, const ProjectedFragments::Fragment& fragment,
                            std::size_t first_axis) {
  const PatchBlock& block = at(blocks_.blocks, fragment.patch);
  std::size_t first = lines_.size();
  for (const std::int32_t count : {block.columns, block.rows, block.strips}) {
    axes_[first_axis++] = {count, first, 0};
    first += static_cast<std::size_t>(count - 1);
  }
  if (block.is_single()) {
    return;
  }
  const auto outline = blocks_.scene->outline(fragment.patch);
  std::array<GridPoint, 5> corners;
  double far = 0;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    corners[k] = at(projected_.grid.points, outline[k]);
    corners[k].x -= frame.origin.x;
    corners[k].y -= frame.origin.y;
    far = std::max({far, std::abs(static_cast<double>(corners[k].x)),
                    std::abs(static_cast<double>(corners[k].y))});
  }
  if (frame.kept == NeedleFrame::Kept::both && far <= most_far * own_far_) {
    add_lines(
        block, outline.size(), fragment.front,
        [&](std::size_t p, std::size_t q, double t) {
          const auto x = static_cast<double>(corners[p].x), y = static_cast<double>(corners[p].y);
          return NeedleFrame::Point{x + t * static_cast<double>(corners[q].x - corners[p].x),
                                    y + t * static_cast<double>(corners[q].y - corners[p].y)};
        },
        [](const NeedleFrame::Point& a, const NeedleFrame::Point& b) {
          const double dx = b.x - a.x, dy = b.y - a.y;
          return NeedleFrame::Line{dx, dy, dy * a.x - dx * a.y};
        });
    return;
  }
  add_lines(
      block, outline.size(), fragment.front,
      [&](std::size_t p, std::size_t q, double t) {
        const GridPoint &a = corners[p], &b = corners[q];
        const long double x = static_cast<long double>(b.x - a.x) * static_cast<long double>(t);
        const long double y = static_cast<long double>(b.y - a.y) * static_cast<long double>(t);
        const long long whole_x = std::llrint(x), whole_y = std::llrint(y);
        return FinePoint{{a.x + whole_x + frame.origin.x, a.y + whole_y + frame.origin.y},
                         static_cast<double>(x - static_cast<long double>(whole_x)),
                         static_cast<double>(y - static_cast<long double>(whole_y))};
      },
      [&](const FinePoint& a, const FinePoint& b) { return frame.map(a, b); });
}

/// @param between gives a point of an edge of the outline
/// @param through gives the line through two of them
template <class Between, class Through>
void BlockOverlay::add_lines(const PatchBlock& block, std::size_t corners, bool front,
                             Between between, Through through) {
  const auto on_edge = [&](std::size_t edge, double t) {
    return between(edge, edge + 1 < corners ? edge + 1 : 0, t);
  };
  const PatchBlocks::Line* line = blocks_.lines.data() + block.lines;
  const std::int32_t count = block.columns + block.rows + block.strips - 3;
  for (std::int32_t k = 0; k < count; ++k, ++line) {
    const auto from = on_edge(line->from_edge, line->from), to = on_edge(line->to_edge, line->to);
    // Seen from behind, left is right.
    lines_.push_back(front ? through(from, to) : through(to, from));
  }
}

void BlockOverlay::finish() {
  if (!pool_.empty()) {
    divide_axis(0, 0);
  }
}

/// Divides the part in pool_ from `begin`, and takes it away.
void BlockOverlay::divide_axis(std::size_t axis, std::size_t begin) {
  if (axis == axes_.size()) {
    add_cell(begin);
    return;
  }
  const std::int32_t count = axes_[axis].count;
  if (axis % 3 == 2 && count > 1) {
    // Two strips cross a cell.
    const std::int32_t low = axes_[axis - 2].chosen + axes_[axis - 1].chosen;
    divide_axis(axis, std::min(low, count - 1), std::min(low + 1, count - 1), begin);
  } else {
    divide_axis(axis, 0, count - 1, begin);
  }
}

/// The same of a part that lies in columns, rows or strips `low` to `high`.
void BlockOverlay::divide_axis(std::size_t axis, std::int32_t low, std::int32_t high,
                               std::size_t begin) {
  if (low == high) {
    axes_[axis].chosen = low;
    divide_axis(axis + 1, begin);
    return;
  }
  // All below `middle` lies left of the line before it.
  const std::int32_t middle = (low + high + 1) / 2;
  std::size_t right = 0;
  const int side =
      cut(lines_[axes_[axis].lines + static_cast<std::size_t>(middle) - 1], begin, right);
  if (side < 0) {
    divide_axis(axis, middle, high, begin);
  } else if (side > 0) {
    divide_axis(axis, low, middle - 1, begin);
  } else {
    divide_axis(axis, middle, high, right);
    divide_axis(axis, low, middle - 1, begin);
  }
}

/// Cuts the part from `begin` by a line: its left part stays, its right part follows from `right`.
/// Returns 1 if all of it lies left of the line, -1 if right of it, 0 if it was cut.
int BlockOverlay::cut(const NeedleFrame::Line& line, std::size_t begin, std::size_t& right) {
  const auto side = [&](double x, double y) { return line.dx * y - line.dy * x + line.c; };
  const std::size_t end = pool_.size();
  bool any_left = false, any_right = false;
  for (std::size_t k = begin; k < end; ++k) {
    const bool left = side(pool_[k].ax, pool_[k].ay) > 0;
    any_left |= left;
    any_right |= !left;
  }
  if (!any_left || !any_right) {
    return any_left ? 1 : -1;
  }
  crossings_.clear();
  right_.clear();
  std::size_t kept = begin;
  for (std::size_t k = begin; k < end; ++k) {
    const BoundarySegment s = pool_[k];
    const double a = side(s.ax, s.ay), b = side(s.bx, s.by);
    if ((a > 0) == (b > 0)) {
      if (a > 0) {
        pool_[kept++] = s;
      } else {
        right_.push_back(s);
      }
      continue;
    }
    const double t = a / (a - b);
    const double x = s.ax + t * (s.bx - s.ax), y = s.ay + t * (s.by - s.ay);
    if (a > 0) {
      pool_[kept++] = {s.ax, s.ay, x, y};
      right_.push_back({x, y, s.bx, s.by});
    } else {
      right_.push_back({s.ax, s.ay, x, y});
      pool_[kept++] = {x, y, s.bx, s.by};
    }
    crossings_.push_back({line.dx * x + line.dy * y, x, y, a > 0 ? 1 : -1});
  }
  pool_.resize(kept);
  close();
  right = pool_.size();
  pool_.insert(pool_.end(), right_.begin(), right_.end());
  return 0;
}

/// Adds what bounds both parts along the line.
void BlockOverlay::close() {
  std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& p, const Crossing& q) {
    return p.along != q.along ? p.along < q.along : p.change > q.change;
  });
  int winding = 0;
  for (std::size_t k = 0; k + 1 < crossings_.size(); ++k) {
    winding += crossings_[k].change;
    const Crossing &from = crossings_[k], &to = crossings_[k + 1];
    // Other than 0 and 1 by rounding only.
    for (int n = 0; n < std::abs(winding); ++n) {
      const bool forward = winding > 0;
      const Crossing &p = forward ? from : to, &q = forward ? to : from;
      pool_.push_back({p.x, p.y, q.x, q.y});
      right_.push_back({q.x, q.y, p.x, p.y});
    }
  }
}

PatchId BlockOverlay::chosen_patch(const PatchBlock& block, std::size_t first_axis) const {
  // Beside the diagonal that bounds the outline there are no patches.
  if (axes_[first_axis + 2].chosen < axes_[first_axis].chosen + axes_[first_axis + 1].chosen &&
      block.has_halves()) {
    return no_patch;
  }
  const std::int32_t index = block.index(axes_[first_axis].chosen, axes_[first_axis + 1].chosen,
                                         axes_[first_axis + 2].chosen);
  return blocks_.patches[block.patches + static_cast<std::size_t>(index)];
}

void BlockOverlay::add_cell(std::size_t begin) {
  double twice_area = 0;
  const double x = pool_[begin].ax, y = pool_[begin].ay;
  for (std::size_t k = begin; k < pool_.size(); ++k) {
    const BoundarySegment& s = pool_[k];
    twice_area += (s.ax - x) * (s.by - y) - (s.ay - y) * (s.bx - x);
  }
  Cell cell{chosen_patch(*own_, 0), chosen_patch(*other_, 3), 0.5 * twice_area,
            static_cast<std::uint32_t>(kept_.size()), 0};
  // Beside the outline of a block there is nothing but rounding.
  if (cell.own != no_patch && cell.other != no_patch) {
    if (keep_segments_) {
      kept_.insert(kept_.end(), pool_.begin() + static_cast<std::ptrdiff_t>(begin), pool_.end());
    }
    cell.end = static_cast<std::uint32_t>(kept_.size());
    cells_.push_back(cell);
  }
  pool_.resize(begin);
}

}  // namespace transillum
