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
  add_axes(frame, other, 2);
}

std::span<const BlockOverlay::Cell> BlockOverlay::divide_outline(
    const ProjectedFragments::Fragment& fragment) {
  const std::size_t count = fragment.end - fragment.begin;
  const auto corners =
      std::span<const GridPoint>(projected_.corners).subspan(fragment.begin, count);
  const NeedleFrame frame = NeedleFrame::around(corners, corners[0]);
  begin_query();
  begin(frame, fragment, fragment, false);
  axes_[2].count = axes_[3].count = 1;
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
  axes_[first_axis] = {block.columns, lines_.size(), 0};
  axes_[first_axis + 1] = {block.rows, lines_.size() + static_cast<std::size_t>(block.columns) - 1,
                           0};
  if (block.is_single()) {
    return;
  }
  std::array<GridPoint, 4> corners;
  double far = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = at(projected_.grid.points, blocks_.scene->outline(fragment.patch)[k]);
    corners[k].x -= frame.origin.x;
    corners[k].y -= frame.origin.y;
    far = std::max({far, std::abs(static_cast<double>(corners[k].x)),
                    std::abs(static_cast<double>(corners[k].y))});
  }
  if (frame.kept == NeedleFrame::Kept::both && far <= most_far * own_far_) {
    add_lines(
        block, fragment.front,
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
      block, fragment.front,
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
void BlockOverlay::add_lines(const PatchBlock& block, bool front, Between between,
                             Through through) {
  const auto add = [&](const auto& from, const auto& to) {
    // Seen from behind, left is right.
    lines_.push_back(front ? through(from, to) : through(to, from));
  };
  const PatchBlocks::Line* line = blocks_.lines.data() + block.lines;
  for (std::int32_t c = 1; c < block.columns; ++c, ++line) {
    add(between(0, 1, line->from), between(3, 2, line->to));
  }
  for (std::int32_t r = 1; r < block.rows; ++r, ++line) {
    add(between(1, 2, line->from), between(0, 3, line->to));
  }
}

void BlockOverlay::finish() {
  if (!pool_.empty()) {
    divide_axis(0, 0, axes_[0].count - 1, 0);
  }
}

/// Divides the part in pool_ from `begin`, which lies in columns or rows `low` to `high`, and takes
/// it away.
void BlockOverlay::divide_axis(std::size_t axis, std::int32_t low, std::int32_t high,
                               std::size_t begin) {
  if (low == high) {
    axes_[axis].chosen = low;
    if (axis + 1 == axes_.size()) {
      add_cell(begin);
    } else {
      divide_axis(axis + 1, 0, axes_[axis + 1].count - 1, begin);
    }
    return;
  }
  // Columns below `middle` lie left of the line before it.
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
  close(line);
  right = pool_.size();
  pool_.insert(pool_.end(), right_.begin(), right_.end());
  return 0;
}

/// Adds what bounds both parts along the line.
void BlockOverlay::close(const NeedleFrame::Line&) {
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

void BlockOverlay::add_cell(std::size_t begin) {
  double twice_area = 0;
  const double x = pool_[begin].ax, y = pool_[begin].ay;
  for (std::size_t k = begin; k < pool_.size(); ++k) {
    const BoundarySegment& s = pool_[k];
    twice_area += (s.ax - x) * (s.by - y) - (s.ay - y) * (s.bx - x);
  }
  Cell cell{own_->patch(axes_[0].chosen, axes_[1].chosen),
            other_->patch(axes_[2].chosen, axes_[3].chosen), 0.5 * twice_area,
            static_cast<std::uint32_t>(kept_.size()), 0};
  if (keep_segments_) {
    kept_.insert(kept_.end(), pool_.begin() + static_cast<std::ptrdiff_t>(begin), pool_.end());
  }
  cell.end = static_cast<std::uint32_t>(kept_.size());
  cells_.push_back(cell);
  pool_.resize(begin);
}

}  // namespace transillum
