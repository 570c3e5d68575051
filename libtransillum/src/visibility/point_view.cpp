// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/point_view.h"

#include <algorithm>

namespace transillum {
namespace {

/// Coordinates about a point: `depth` runs toward the plane that is looked at.
struct Frame {
  Frame(const Vec3& origin_of, const Vec3& toward) : origin(origin_of), depth(toward) {
    u = normalized(cross(std::abs(depth.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, depth));
    v = cross(depth, u);
  }
  Vec3 coordinates(const Vec3& p) const {
    const Vec3 off = p - origin;
    return {dot(off, u), dot(off, v), dot(off, depth)};
  }

  Vec3 origin, u, v, depth;
};

PlaneRegion::Side unit_side(double a, double b, double c) {
  const double length = std::hypot(a, b);
  return length > 0 ? PlaneRegion::Side{a / length, b / length, c / length} : PlaneRegion::Side{};
}

bool is_line(const PlaneRegion::Side& side) { return side.a != 0 || side.b != 0; }

using Sides = boost::container::small_vector<PlaneRegion::Side, 8>;

}  // namespace

double PointView::form_factor(const Vec3& x, const Vec3& normal, Outline polygon,
                              const std::vector<Corners>& blockers) {
  const HalfSpace front = lit_half_space(polygon);
  const double height = front.distance(x);
  if (height <= 0) return 0;
  const Frame frame(x, -front.normal);
  boost::container::small_vector<PlaneRegion::Point, 12> corners;
  for (const Vec3& corner : polygon) {
    const Vec3 p = frame.coordinates(corner);
    corners.push_back({p.x / height, p.y / height});
  }
  region_.assign({corners.data(), corners.size()});

  for (const Corners& blocker : blockers) {
    // Only what is between x and the plane throws a shadow on it.
    constexpr double near = 1e-12;
    Corners between;
    for (const Vec3& corner : blocker) between.push_back(frame.coordinates(corner) / height);
    const auto out_of_range = [&](const Vec3& p) { return p.z < near || p.z > 1; };
    if (std::any_of(between.begin(), between.end(), out_of_range)) {
      between = clipped(clipped(between, {{0, 0, 1}, near}), {{0, 0, -1}, -1});
    }
    if (between.empty()) continue;
    PlaneRegion::Box box;
    double orientation = 0;
    Sides sides;
    const Vec3 area = area_vector(between);
    orientation = dot(area, between[0]);
    if (orientation == 0) continue;  // seen edge-on
    for (std::size_t k = 0; k < between.size(); ++k) {
      const Vec3 &a = between[k], &b = between[k + 1 < between.size() ? k + 1 : 0];
      box.add({a.x / a.z, a.y / a.z});
      const Vec3 across = (orientation > 0 ? 1 : -1) * cross(a, b);
      const PlaneRegion::Side side = unit_side(across.x, across.y, across.z);
      if (is_line(side)) sides.push_back(side);
    }
    region_.subtract({sides.data(), sides.size()}, box);
    if (region_.empty()) return 0;
  }

  double sum = 0;
  const Vec3 n{dot(normal, frame.u), dot(normal, frame.v), dot(normal, frame.depth)};
  region_.for_each([&](std::span<const PlaneRegion::Point> part) {
    Corners lifted;
    for (const PlaneRegion::Point& p : part) lifted.push_back({p.u, p.v, 1});
    sum += point_form_factor({}, n, lifted);
  });
  return sum;
}

std::vector<Corners> uncovered(Outline polygon, const std::vector<Corners>& covers) {
  const HalfSpace front = lit_half_space(polygon);
  const Frame frame(polygon[0], front.normal);
  const auto flat = [&](const Vec3& p) {
    const Vec3 q = frame.coordinates(p);
    return PlaneRegion::Point{q.x, q.y};
  };
  boost::container::small_vector<PlaneRegion::Point, 12> corners;
  for (const Vec3& corner : polygon) corners.push_back(flat(corner));
  PlaneRegion region;
  region.assign({corners.data(), corners.size()});
  for (const Corners& cover : covers) {
    PlaneRegion::Box box;
    Sides sides;
    for (std::size_t k = 0; k < cover.size(); ++k) {
      const PlaneRegion::Point a = flat(cover[k]),
                               b = flat(cover[k + 1 < cover.size() ? k + 1 : 0]);
      box.add(a);
      const PlaneRegion::Side side = unit_side(a.v - b.v, b.u - a.u, a.u * b.v - a.v * b.u);
      if (is_line(side)) sides.push_back(side);
    }
    region.subtract({sides.data(), sides.size()}, box);
  }
  std::vector<Corners> parts;
  region.for_each([&](std::span<const PlaneRegion::Point> part) {
    Corners lifted;
    for (const PlaneRegion::Point& p : part)
      lifted.push_back(polygon[0] + p.u * frame.u + p.v * frame.v);
    parts.push_back(lifted);
  });
  return parts;
}

}  // namespace transillum
