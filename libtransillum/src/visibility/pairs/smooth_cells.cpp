// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/smooth_cells.h"

#include <algorithm>

namespace transillum {
namespace {

constexpr std::size_t most_blockers = 8, most_lines = 12;

/// The cells of a polygon, cut by one plane after the other.
class Cells {
 public:
  Cells(Outline polygon, double tolerance) : tolerance_(tolerance) {
    cells_.emplace_back().assign(polygon.begin(), polygon.end());
  }

  bool full() const { return lines_.size() > most_lines; }
  std::vector<Corners> take() && { return std::move(cells_); }

  /// Cuts by the plane through `apex` and the edge from a to b, where the sector that they span
  /// meets the polygon: beyond the edge, or beyond the apex (`sign` -1).
  void cut(const Vec3& apex, const Vec3& a, const Vec3& b, double sign) {
    const Vec3 to_a = sign * (a - apex), to_b = sign * (b - apex);
    const Vec3 across = cross(to_a, to_b);
    const double length = norm(across);
    if (length <= tolerance_ * max_abs(to_a)) {
      return;
    }
    HalfSpace side{across / length};
    side.offset = dot(side.normal, apex);
    const Corners& whole = cells_.front();
    if (lines_.empty() ? !meets(whole, side, apex, to_a, to_b)
                       : std::none_of(cells_.begin(), cells_.end(), [&](const Corners& cell) {
                           return meets(cell, side, apex, to_a, to_b);
                         })) {
      return;
    }
    lines_.push_back(side);
    if (full()) {
      return;
    }
    split(side);
  }

 private:
  /// Whether the plane cuts the polygon within the sector.
  bool meets(const Corners& polygon, const HalfSpace& side, const Vec3& apex, const Vec3& to_a,
             const Vec3& to_b) const {
    const Vec3 after_a = cross(side.normal, to_a), before_b = cross(to_b, side.normal);
    double low = 0, high = 0;
    bool reaches_a = false, reaches_b = false;
    for (const Vec3& x : polygon) {
      const double distance = side.distance(x);
      low = std::min(low, distance);
      high = std::max(high, distance);
      reaches_a = reaches_a || dot(after_a, x - apex) > 0;
      reaches_b = reaches_b || dot(before_b, x - apex) > 0;
    }
    return low < -tolerance_ && high > tolerance_ && reaches_a && reaches_b;
  }

  void split(const HalfSpace& side) {
    const HalfSpace opposite{-side.normal, -side.offset};
    for (std::size_t k = cells_.size(); k-- > 0;) {
      const auto is_beyond = [&](const HalfSpace& of) {
        return std::any_of(cells_[k].begin(), cells_[k].end(),
                           [&](const Vec3& x) { return of.distance(x) > tolerance_; });
      };
      if (is_beyond(side) && is_beyond(opposite)) {
        Corners rest = clipped(cells_[k], opposite, tolerance_);
        cells_[k] = clipped(cells_[k], side, tolerance_);
        cells_.push_back(std::move(rest));
      }
    }
  }

  double tolerance_;
  std::vector<Corners> cells_;
  std::vector<HalfSpace> lines_;
};

}  // namespace

std::vector<Corners> smooth_cells(Outline small, Outline large,
                                  const std::vector<Corners>& blockers, double tolerance) {
  Cells cells(small, tolerance);
  const auto for_each_edge = [](Outline polygon, auto visit) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      visit(polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0]);
    }
  };
  for (const Corners& blocker : blockers) {
    if (blockers.size() > most_blockers || cells.full()) {
      break;
    }
    for_each_edge(blocker, [&](const Vec3& a, const Vec3& b) {
      for (const Vec3& corner : large) {
        cells.cut(corner, a, b, 1);
      }
    });
    for_each_edge(large, [&](const Vec3& a, const Vec3& b) {
      for (const Vec3& corner : blocker) {
        cells.cut(corner, a, b, -1);
      }
    });
  }
  return cells.full() ? Cells(small, tolerance).take() : std::move(cells).take();
}

}  // namespace transillum
