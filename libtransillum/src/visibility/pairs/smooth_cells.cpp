// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/refined_cells.h"

#include <algorithm>
#include <array>

namespace transillum {
namespace {

constexpr std::size_t most_blockers = 8, most_lines = 12;

/// An edge of a polygon.
struct Side {
  Vec3 begin, end;
};

template <class Visit>
void for_each_side(Outline polygon, Visit&& visit) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    visit(Side{polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0]});
  }
}

/// Up to rounding of coordinates to single precision, or to six digits in a file. What is not quite
/// parallel spreads the kink over that much of its length: far less than the distance of points.
bool are_parallel(const Side& a, const Side& b) {
  constexpr double sine = 1e-4;
  const Vec3 along_a = a.end - a.begin, along_b = b.end - b.begin;
  const Vec3 across = cross(along_a, along_b);
  return dot(across, across) <= sine * sine * dot(along_a, along_a) * dot(along_b, along_b);
}

/// The cells of a polygon, cut by one plane after the other.
class Cells {
 public:
  Cells(Outline polygon, double tolerance) : tolerance_(tolerance) {
    cells_.emplace_back().assign(polygon.begin(), polygon.end());
  }

  bool full() const { return lines_ >= most_lines; }
  std::vector<Corners> take() && { return std::move(cells_); }

  /// Cuts by the plane of a polygon that crosses a cell, or stands on it.
  void cut_where_met(Outline polygon) {
    const Corners& any = cells_[0];
    const HalfSpace floor = lit_half_space(any), wall = lit_half_space(polygon);
    constexpr double parallel = 1e-6;
    if (full() || norm(cross(floor.normal, wall.normal)) < parallel) {
      return;
    }
    const std::array<Vec3, 2> foot = foot_of(polygon, floor);
    if (std::any_of(cells_.begin(), cells_.end(), [&](const Corners& cell) {
          return is_cut(cell, wall) && is_segment_in(cell, floor.normal, foot);
        })) {
      split(wall);
      ++lines_;
    }
  }

  /// Cuts by the plane through two parallel edges, if the shadow of the one before the light from
  /// the other may reach a cell.
  void cut(const Side& edge, const Side& light) {
    const Vec3 across = cross(edge.end - edge.begin, light.begin - edge.begin);
    const double length = norm(across);
    if (full() || length <= tolerance_ * norm(edge.end - edge.begin)) {
      return;
    }
    const Vec3 normal = across / length;
    const HalfSpace plane{normal, dot(normal, edge.begin)};
    if (std::any_of(cells_.begin(), cells_.end(), [&](const Corners& cell) {
          return is_cut(cell, plane) && (is_shadow_in(cell, plane, edge, light.begin) ||
                                         is_shadow_in(cell, plane, edge, light.end));
        })) {
      split(plane);
      ++lines_;
    }
  }

 private:
  /// The ends of the part of a polygon that lies in a plane, up to the tolerance; equal if none
  /// does or the polygon only touches it.
  std::array<Vec3, 2> foot_of(Outline polygon, const HalfSpace& plane) const {
    std::array<Vec3, 2> foot{};
    int found = 0;
    const auto add = [&](const Vec3& x) {
      if (found == 0) {
        foot = {x, x};
      } else if (norm(x - foot[0]) > norm(foot[1] - foot[0])) {
        foot[1] = x;
      }
      ++found;
    };
    for_each_side(polygon, [&](const Side& side) {
      const double begin = plane.distance(side.begin), end = plane.distance(side.end);
      if (std::abs(begin) <= tolerance_) {
        add(side.begin);
      } else if (std::abs(end) > tolerance_ && (begin > 0) != (end > 0)) {
        add(side.begin + begin / (begin - end) * (side.end - side.begin));
      }
    });
    return foot;
  }

  /// Whether part of a segment, longer than the tolerance, lies inside a polygon of its plane.
  bool is_segment_in(const Corners& polygon, const Vec3& normal,
                     const std::array<Vec3, 2>& segment) const {
    double from = 0, to = 1;
    for_each_side(polygon, [&](const Side& side) {
      const Vec3 inward = cross(normal, side.end - side.begin);
      const double begin = dot(inward, segment[0] - side.begin);
      const double end = dot(inward, segment[1] - side.begin);
      if (begin <= 0 && end <= 0) {
        to = 0;
      } else if (begin < 0) {
        from = std::max(from, begin / (begin - end));
      } else if (end < 0) {
        to = std::min(to, begin / (begin - end));
      }
    });
    return (to - from) * norm(segment[1] - segment[0]) > tolerance_;
  }

  bool is_cut(const Corners& polygon, const HalfSpace& plane) const {
    bool below = false, above = false;
    for (const Vec3& x : polygon) {
      const double distance = plane.distance(x);
      below = below || distance < -tolerance_;
      above = above || distance > tolerance_;
    }
    return below && above;
  }

  /// Whether the polygon reaches between the planes through `light` and the ends of the edge that
  /// are perpendicular to `plane`, on the edge's side of `light`.
  static bool is_shadow_in(const Corners& polygon, const HalfSpace& plane, const Side& edge,
                           const Vec3& light) {
    const Vec3 to_begin = edge.begin - light, to_end = edge.end - light;
    const double turn = dot(plane.normal, cross(to_begin, to_end)) > 0 ? 1 : -1;
    const Vec3 after = turn * cross(plane.normal, to_begin),
               before = turn * cross(to_end, plane.normal);
    bool reaches_begin = false, reaches_end = false;
    for (const Vec3& x : polygon) {
      reaches_begin = reaches_begin || dot(after, x - light) > 0;
      reaches_end = reaches_end || dot(before, x - light) > 0;
    }
    return reaches_begin && reaches_end;
  }

  void split(const HalfSpace& plane) {
    const HalfSpace opposite{-plane.normal, -plane.offset};
    for (std::size_t k = cells_.size(); k-- > 0;) {
      if (is_cut(cells_[k], plane)) {
        Corners rest = clipped(cells_[k], opposite, tolerance_);
        cells_[k] = clipped(cells_[k], plane, tolerance_);
        cells_.push_back(std::move(rest));
      }
    }
  }

  double tolerance_;
  std::vector<Corners> cells_;
  std::size_t lines_ = 0;  ///< that cut a cell
};

}  // namespace

std::vector<Corners> smooth_cells(Outline sampled, Outline other,
                                  const std::vector<Corners>& blockers, double tolerance) {
  Cells cells(sampled, tolerance);
  for (const Corners& blocker : blockers) {
    cells.cut_where_met(blocker);
  }
  if (blockers.size() > most_blockers) {
    return std::move(cells).take();
  }
  for (const Corners& blocker : blockers) {
    for_each_side(blocker, [&](const Side& edge) {
      for_each_side(other, [&](const Side& light) {
        if (!cells.full() && are_parallel(edge, light)) {
          cells.cut(edge, light);
        }
      });
    });
  }
  return std::move(cells).take();
}

}  // namespace transillum
