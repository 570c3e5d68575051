// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "geometry/plane_region.h"

namespace transillum {

void PlaneRegion::assign(std::span<const Point> polygon) {
  constexpr double rounding = 1e-14;
  corners_.assign(polygon.begin(), polygon.end());
  Convex convex{0, static_cast<std::uint32_t>(corners_.size()), {}};
  for (const Point& p : polygon) {
    convex.box.add(p);
  }
  tolerance_ = rounding * std::max({-convex.box.low.u, convex.box.high.u, -convex.box.low.v,
                                    convex.box.high.v, convex.box.high.u - convex.box.low.u});
  convex_.assign(1, convex);
}

void PlaneRegion::subtract(std::span<const Side> sides, const Box& box) {
  left_.clear();
  for (const Convex& convex : convex_) {
    if (convex.box.overlaps(box)) {
      subtract_from(convex, sides);
    } else {
      left_.push_back(convex);
    }
  }
  convex_.swap(left_);
}

bool PlaneRegion::is_outside(const Convex& convex, const Side& side) const {
  const auto points = corners(convex);
  return std::all_of(points.begin(), points.end(),
                     [&](const Point& p) { return side.distance(p) <= tolerance_; });
}

/// The part outside the first side remains; of the rest, the part outside the second; and so on.
void PlaneRegion::subtract_from(Convex convex, std::span<const Side> sides) {
  if (std::any_of(sides.begin(), sides.end(),
                  [&](const Side& side) { return is_outside(convex, side); })) {
    left_.push_back(convex);
    return;
  }
  for (const Side& side : sides) {
    const Side opposite{-side.a, -side.b, -side.c};
    if (is_outside(convex, opposite)) {
      continue;
    }
    left_.push_back(kept(convex, opposite));
    convex = kept(convex, side);
    if (is_outside(convex, side)) {
      return;
    }
  }
}

/// The part of `part` inside a side that cuts it.
PlaneRegion::Convex PlaneRegion::kept(const Convex& convex, const Side& side) {
  Convex inside{static_cast<std::uint32_t>(corners_.size()), 0, {}};
  const auto keep = [&](const Point& p) {
    corners_.push_back(p);
    inside.box.add(p);
  };
  const auto distance_to = [&](const Point& p) {
    const double distance = side.distance(p);
    return std::abs(distance) <= tolerance_ ? 0.0 : distance;
  };
  Point last = corners_[convex.end - 1];
  double last_distance = distance_to(last);
  for (std::uint32_t k = convex.begin; k < convex.end; ++k) {
    const Point point = corners_[k];
    const double distance = distance_to(point);
    if ((last_distance > 0 && distance < 0) || (last_distance < 0 && distance > 0)) {
      const double t = last_distance / (last_distance - distance);
      keep({last.u + t * (point.u - last.u), last.v + t * (point.v - last.v)});
    }
    if (distance >= 0) {
      keep(point);
    }
    last = point;
    last_distance = distance;
  }
  inside.end = static_cast<std::uint32_t>(corners_.size());
  return inside;
}

}  // namespace transillum
