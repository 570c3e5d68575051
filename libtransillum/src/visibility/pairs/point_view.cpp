// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Visible parts of a polygon, as regions of the plane: PointView subtracts the projections of
// blockers from a point, uncovered() subtracts coplanar polygons.
#include "visibility/pairs/point_view.h"

#include <algorithm>
#include <cmath>

#include "geometry/point_moments.h"

namespace transillum {
namespace {

/// Adds the left side of the line a x + b y + c = 0, unless a = b = 0.
void add_side(std::vector<PlaneRegion::Side>& sides, double a, double b, double c) {
  const double square = a * a + b * b;
  if (square == 0) {
    return;
  }
  const double scale = 1 / std::sqrt(square);
  sides.push_back({scale * a, scale * b, scale * c});
}

}  // namespace

ViewFrame::ViewFrame(const Vec3& origin_of, const Vec3& depth_of)
    : origin(origin_of), depth(depth_of) {
  u = normalized(cross(std::abs(depth.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, depth));
  v = cross(depth, u);
}

PointView::PointView(Outline polygon, std::span<const Corners> blockers)
    : frame_(polygon[0], -lit_half_space(polygon).normal) {
  for (const Vec3& corner : polygon) {
    polygon_.push_back(frame_.coordinates(corner));
  }
  Corners all;
  for (const Corners& blocker : blockers) {
    all.clear();
    for (const Vec3& corner : blocker) {
      all.push_back(frame_.coordinates(corner));
    }
    Corners before = clipped(all, {{0, 0, -1}, 0});
    if (!before.empty()) {
      blockers_.push_back(before);
    }
  }
}

double PointView::form_factor(const Vec3& x, const Vec3& normal,
                              const std::function<void()>& tick) {
  return see(frame_.coordinates(x), tick) ? visible_form_factor(frame_.turned(normal)) : 0;
}

PointView::Moments PointView::moments(const Vec3& x, const Vec3& normal,
                                      const std::function<void()>& tick) {
  Moments moments;
  const Vec3 at = frame_.coordinates(x);
  if (!see(at, tick)) {
    return moments;
  }
  const Vec3 turned = frame_.turned(normal);
  moments.one = visible_form_factor(turned);
  double u = 0, v = 0;
  region_.for_each([&](std::span<const PlaneRegion::Point> part) {
    const PointMoments of_part = point_moments(turned, part);
    u += of_part.u;
    v += of_part.v;
  });
  moments.foot = x - at.z * frame_.depth;
  moments.first = -at.z * (u * frame_.u + v * frame_.v);
  return moments;
}

/// Makes region_ the visible part, at distance 1 from a point. Returns whether there is any.
/// @param at the point, in coordinates of frame_
bool PointView::see(const Vec3& at, const std::function<void()>& tick) {
  if (at.z >= 0) {
    return false;
  }
  projected_.clear();
  for (const Vec3& corner : polygon_) {
    projected_.push_back({(corner.x - at.x) / -at.z, (corner.y - at.y) / -at.z});
  }
  region_.assign({projected_.data(), projected_.size()});
  for (const Corners& blocker : blockers_) {
    if (tick) {
      tick();
    }
    subtract(blocker, at);
    if (region_.empty()) {
      return false;
    }
  }
  return true;
}

double PointView::visible_form_factor(const Vec3& turned) const {
  double sum = 0;
  region_.for_each([&](std::span<const PlaneRegion::Point> part) {
    Corners lifted;
    for (const PlaneRegion::Point& p : part) {
      lifted.push_back({p.u, p.v, 1});
    }
    sum += point_form_factor({}, turned, lifted);
  });
  return sum;
}

/// Subtracts the projection of a blocker from x. Parts of it that are not beyond x do not block.
void PointView::subtract(const Corners& blocker, const Vec3& x) {
  constexpr double near = 1e-12, vanishing = 1e-12;
  between_.clear();
  double nearest = HUGE_VAL;
  for (const Vec3& corner : blocker) {
    between_.push_back(corner - x);
    nearest = std::min(nearest, between_.back().z);
  }
  if (nearest < near * -x.z) {
    between_ = clipped(between_, {{0, 0, 1}, near * -x.z});
  }
  if (between_.empty()) {
    return;
  }
  const double orientation = dot(area_vector(between_), between_[0]);
  if (orientation == 0) {
    return;  // seen edge-on
  }
  const double sign = orientation > 0 ? 1 : -1;
  PlaneRegion::Box box;
  sides_.clear();
  for (std::size_t k = 0; k < between_.size(); ++k) {
    const Vec3 &a = between_[k], &b = between_[k + 1 < between_.size() ? k + 1 : 0];
    box.add({a.x / a.z, a.y / a.z});
    const Vec3 across = sign * cross(a, b);
    // A cut has left next to nothing of an edge: its direction is noise.
    if (dot(across, across) <= vanishing * vanishing * dot(a, a) * dot(b, b)) {
      continue;
    }
    add_side(sides_, across.x, across.y, across.z);
  }
  region_.subtract(sides_, box);
}

std::vector<Corners> uncovered(Outline polygon, const std::vector<Corners>& covers) {
  const ViewFrame frame(polygon[0], lit_half_space(polygon).normal);
  const auto flat = [&](const Vec3& p) {
    const Vec3 q = frame.coordinates(p);
    return PlaneRegion::Point{q.x, q.y};
  };
  boost::container::small_vector<PlaneRegion::Point, 12> corners;
  for (const Vec3& corner : polygon) {
    corners.push_back(flat(corner));
  }
  PlaneRegion region;
  region.assign({corners.data(), corners.size()});
  for (const Corners& cover : covers) {
    PlaneRegion::Box box;
    std::vector<PlaneRegion::Side> sides;
    for (std::size_t k = 0; k < cover.size(); ++k) {
      const PlaneRegion::Point a = flat(cover[k]),
                               b = flat(cover[k + 1 < cover.size() ? k + 1 : 0]);
      box.add(a);
      add_side(sides, a.v - b.v, b.u - a.u, a.u * b.v - a.v * b.u);
    }
    region.subtract(sides, box);
  }
  std::vector<Corners> parts;
  region.for_each([&](std::span<const PlaneRegion::Point> part) {
    Corners lifted;
    for (const PlaneRegion::Point& p : part) {
      lifted.push_back(polygon[0] + p.u * frame.u + p.v * frame.v);
    }
    parts.push_back(lifted);
  });
  return parts;
}

}  // namespace transillum
