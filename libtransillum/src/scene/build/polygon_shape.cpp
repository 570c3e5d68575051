// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/build/polygon_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/build/precision.h"
#include "transillum/at.h"

namespace transillum {
namespace {

Vec3 centroid(std::span<const Vec3> points, std::span<const PointId> outline, const Vec3& normal) {
  const Vec3 origin = at(points, outline[0]);
  Vec3 moment;
  double total = 0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const Vec3 a = at(points, outline[i]) - origin;
    const Vec3 b = at(points, outline[i + 1]) - origin;
    const double weight = dot(normal, cross(a, b));
    moment = moment + weight * (a + b);
    total += weight;
  }
  return origin + moment / (3 * total);
}

}  // namespace

PolygonShape measure(std::span<const Vec3> points, std::span<const PointId> outline) {
  PolygonShape shape;
  if (outline.empty()) {
    return shape;
  }
  const auto corner = [&](std::size_t i) -> const Vec3& { return at(points, outline[i]); };
  const std::size_t n = outline.size();
  const Vec3 origin = corner(0);
  Bounds box;
  Vec3 mean;  // relative to the first corner: no cancellation far from the origin
  Vec3 doubled;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = corner(i);
    box.add(p);
    shape.max_coordinate = std::max(shape.max_coordinate, max_abs(p));
    mean = mean + (p - origin) / static_cast<double>(n);
    doubled = doubled + cross(p - origin, corner((i + 1) % n) - origin);
  }
  shape.diameter = box.diagonal();
  shape.area = 0.5 * norm(doubled);
  shape.degenerate = n < 3 || !(shape.area > 4 * epsilon * shape.max_coordinate * shape.diameter);
  if (shape.degenerate) {
    return shape;
  }
  shape.normal = normalized(doubled);
  shape.center = centroid(points, outline, shape.normal);
  for (std::size_t i = 0; i < n && n > 3; ++i) {
    const double distance = std::abs(dot(shape.normal, (corner(i) - origin) - mean));
    shape.deviation = std::max(shape.deviation, distance);
  }
  return shape;
}

bool is_bow_tie(std::span<const Vec3> points, std::span<const PointId> outline) {
  std::vector<PointId> corners(outline.begin(), outline.end());
  std::sort(corners.begin(), corners.end());
  if (corners.size() < 4 || std::adjacent_find(corners.begin(), corners.end()) != corners.end()) {
    return false;
  }
  PolygonShape largest;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const std::array<PointId, 3> triangle{outline[0], outline[i], outline[i + 1]};
    const PolygonShape shape = measure(points, triangle);
    if (!shape.degenerate && shape.area > largest.area) {
      largest = shape;
    }
  }
  if (largest.degenerate) {
    return false;
  }
  const Vec3 origin = at(points, outline[0]);
  return std::all_of(outline.begin(), outline.end(), [&](PointId p) {
    const Vec3 offset = at(points, p) - origin;
    return std::abs(dot(largest.normal, offset)) <= 1e-6 * largest.diameter;
  });
}

std::vector<Vec3> with_crossings(std::span<const Vec3> corners, std::span<const PlanePoint> plane,
                                 std::size_t most) {
  const std::size_t n = corners.size();
  std::size_t count = 0;
  std::vector<std::vector<std::pair<double, Vec3>>> on_edge(n);
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint &a = plane[i], &b = plane[(i + 1) % n];
    for (std::size_t j = i + 1; j < n; ++j) {
      const PlanePoint &c = plane[j], &d = plane[(j + 1) % n];
      if (exact_turn(a, b, c) * exact_turn(a, b, d) < 0 &&
          exact_turn(c, d, a) * exact_turn(c, d, b) < 0) {
        const auto height = [](const PlanePoint& p, const PlanePoint& q, const PlanePoint& r) {
          return std::abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
        };
        // Edges that are collinear but for less than doubles resolve meet anywhere.
        const auto fraction = [](double from, double to) {
          return from + to > 0 ? from / (from + to) : 0.5;
        };
        const double s = fraction(height(c, d, a), height(c, d, b));
        const double t = fraction(height(a, b, c), height(a, b, d));
        if (++count > most) {
          return {};
        }
        const Vec3 crossing = corners[i] + s * (corners[(i + 1) % n] - corners[i]);
        on_edge[i].emplace_back(s, crossing);
        on_edge[j].emplace_back(t, crossing);
      }
    }
  }
  std::vector<Vec3> all;
  for (std::size_t i = 0; i < n; ++i) {
    all.push_back(corners[i]);
    std::sort(on_edge[i].begin(), on_edge[i].end(),
              [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [where, crossing] : on_edge[i]) {
      all.push_back(crossing);
    }
  }
  return all;
}

std::vector<PlanePoint> drop_axis(std::span<const Vec3> points, std::span<const PointId> outline,
                                  const Vec3& normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  std::vector<PlanePoint> plane;
  plane.reserve(outline.size());
  for (const PointId id : outline) {
    const Vec3& p = at(points, id);
    // Swapping the two remaining axes reverses the orientation if the normal is negative.
    if (z >= x && z >= y) {
      plane.push_back(normal.z > 0 ? PlanePoint{p.x, p.y} : PlanePoint{p.y, p.x});
    } else if (x >= y) {
      plane.push_back(normal.x > 0 ? PlanePoint{p.y, p.z} : PlanePoint{p.z, p.y});
    } else {
      plane.push_back(normal.y > 0 ? PlanePoint{p.z, p.x} : PlanePoint{p.x, p.z});
    }
  }
  return plane;
}

}  // namespace transillum
