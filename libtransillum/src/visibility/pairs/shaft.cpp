// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pairs/shaft.h"

#include <algorithm>

namespace transillum {

Shaft::Shaft(const FacingPolygons& facing, double tolerance, const Bends& bends)
    : tolerance_(tolerance), bends_(bends), of_p_(facing.p.size()) {
  const Outline p = facing.p, q = facing.q;
  Bounds bounds;
  for (const Outline polygon : {p, q}) {
    for (const Vec3& corner : polygon) {
      corners_.push_back(corner);
      bounds.add(corner);
    }
  }
  box_ = {bounds.center(), 0.5 * (bounds.high - bounds.low)};
  sides_.push_back({facing.before_p.normal, facing.before_p.offset + bends.p});
  sides_.push_back({facing.before_q.normal, facing.before_q.offset + bends.q});
  for (const auto& [a, b] : {std::pair{p, q}, std::pair{q, p}}) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (const Vec3& apex : b) {
        add_side(a[k], a[k + 1 < a.size() ? k + 1 : 0], apex);
      }
    }
  }
}

/// Adds the plane through an edge of one polygon and a corner of the other, if the hull lies on one
/// side of it.
void Shaft::add_side(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 across = cross(b - a, c - a);
  const double length = norm(across);
  if (length <= tolerance_ * max_abs(c - a)) {
    return;
  }
  HalfSpace side{across / length};
  side.offset = dot(side.normal, a);
  double low = 0, high = 0;
  for (const Vec3& corner : corners_) {
    const double distance = side.distance(corner);
    low = std::min(low, distance);
    high = std::max(high, distance);
    if (low < -tolerance_ && high > tolerance_) {
      return;
    }
  }
  if (high <= tolerance_) {
    side = {-side.normal, -side.offset};
  }
  sides_.push_back(side);
}

bool Shaft::reaches(const CenteredBox& box) const {
  const Vec3 apart = box.center - box_.center, sum = box.half + box_.half;
  if (std::abs(apart.x) > sum.x || std::abs(apart.y) > sum.y || std::abs(apart.z) > sum.z) {
    return false;
  }
  return std::all_of(sides_.begin(), sides_.end(), [&](const HalfSpace& side) {
    return box.reach(side.normal) - side.offset > tolerance_;
  });
}

/// Whether p and q lie on one side of a polygon's plane, up to how bent all three are.
bool Shaft::is_in_front_of(const HalfSpace& back, double bend) const {
  const auto none_reaches = [&](Outline corners, double tolerance) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vec3& x) { return back.distance(x) <= tolerance; });
  };
  const Outline all = corners_;
  return none_reaches(all.first(of_p_), tolerance_ + bend + bends_.p) &&
         none_reaches(all.subspan(of_p_), tolerance_ + bend + bends_.q);
}

bool Shaft::meets(Outline polygon, double bend) const {
  for (const HalfSpace& side : sides_) {
    if (std::all_of(polygon.begin(), polygon.end(),
                    [&](const Vec3& x) { return side.distance(x) <= tolerance_; })) {
      return false;
    }
  }
  const HalfSpace front = lit_half_space(polygon), back{-front.normal, -front.offset};
  if (is_in_front_of(front, bend) || is_in_front_of(back, bend)) {
    return false;
  }
  Corners left;
  left.assign(polygon.begin(), polygon.end());
  for (const HalfSpace& side : sides_) {
    left = clipped(left, {side.normal, side.offset + tolerance_});
    if (left.empty()) {
      return false;
    }
  }
  return true;
}

}  // namespace transillum
