// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The region of the global visibility map about a point, from the recorded local map. A region lies
// inside all fragments that cover the point, whose intersection is a convex polygon, and outside
// all others. Subtracting those from the polygon leaves convex parts; the region consists of the
// part with the point and those connected to it through common edges:
//
//      +-------+---+       The polygon, minus fragment f: parts a, b and c.
//      |   a   |f f|       For a point in a, b is connected; c is not.
//      +-----+-+f f|
//      |  b  |f f f|
//      +-----+f+---+
//      |f f f f| c |
//      +-------+---+
#include "visibility/map/map_region.h"
#include "geometry/polygon_area.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/plane_region.h"

namespace transillum {
namespace {

using Point = PlaneRegion::Point;
using Polygon = std::vector<Point>;

constexpr std::size_t max_parts = 2000;
/// Lengths below this fraction of the polygon's are rounding errors.
constexpr double rounding = 1e-9;

double area_of(const Polygon& polygon) {
  return std::abs(polygon_area(polygon.size(), [&](std::size_t k) {
    return Vec2{polygon[k].u, polygon[k].v};
  }));
}

PlaneRegion::Box box_of(const Polygon& polygon) {
  PlaneRegion::Box box;
  for (const Point& p : polygon) {
    box.add(p);
  }
  return box;
}

double length_of(const PlaneRegion::Box& box) {
  return std::max(box.high.u - box.low.u, box.high.v - box.low.v);
}

/// The sides of a convex polygon, counter-clockwise; none if it is too thin to have an inside, or
/// so thin that rounding has reversed it.
std::vector<PlaneRegion::Side> sides_of(const Polygon& polygon) {
  Point center;
  const auto count = static_cast<double>(polygon.size());
  for (const Point& p : polygon) {
    center.u += p.u / count;
    center.v += p.v / count;
  }
  const double shortest = 1e-14 * length_of(box_of(polygon));
  std::vector<PlaneRegion::Side> sides;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double u = b.u - a.u, v = b.v - a.v, length = std::hypot(u, v);
    if (length <= shortest) {
      continue;
    }
    PlaneRegion::Side side{-v / length, u / length, 0};
    side.c = -side.a * a.u - side.b * a.v;
    if (side.distance(center) <= shortest) {
      return {};
    }
    sides.push_back(side);
  }
  return sides.size() < 3 ? std::vector<PlaneRegion::Side>() : sides;
}

/// Whether the edges of two convex polygons that do not overlap share more than a point.
bool have_common_edge(const Polygon& one, const Polygon& other, double tolerance) {
  for (std::size_t k = 0; k < one.size(); ++k) {
    const Point &a = one[k], &b = one[(k + 1) % one.size()];
    const double length = std::hypot(b.u - a.u, b.v - a.v);
    if (length <= tolerance) {
      continue;
    }
    const Point along{(b.u - a.u) / length, (b.v - a.v) / length};
    // Coordinates from a: along the edge, and perpendicular to it.
    const auto from_a = [&](const Point& p) {
      const Point d{p.u - a.u, p.v - a.v};
      return Point{d.u * along.u + d.v * along.v, d.v * along.u - d.u * along.v};
    };
    for (std::size_t m = 0; m < other.size(); ++m) {
      const Point c = from_a(other[m]), d = from_a(other[(m + 1) % other.size()]);
      if (std::abs(c.v) > tolerance || std::abs(d.v) > tolerance) {
        continue;
      }
      const double common =
          std::min(length, std::max(c.u, d.u)) - std::max(0.0, std::min(c.u, d.u));
      if (common > tolerance) {
        return true;
      }
    }
  }
  return false;
}

/// The first part and those connected to it through common edges.
std::vector<Polygon> connected_to_first(std::vector<Polygon> parts, double tolerance) {
  std::vector<PlaneRegion::Box> boxes;
  for (const Polygon& part : parts) {
    PlaneRegion::Box box = box_of(part);
    box.low = {box.low.u - tolerance, box.low.v - tolerance};
    boxes.push_back(box);
  }
  std::size_t reached = 1;
  for (std::size_t from = 0; from < reached; ++from) {
    for (std::size_t to = reached; to < parts.size(); ++to) {
      if (!boxes[from].overlaps(boxes[to]) ||
          !have_common_edge(parts[from], parts[to], tolerance)) {
        continue;
      }
      std::swap(parts[reached], parts[to]);
      std::swap(boxes[reached], boxes[to]);
      ++reached;
    }
  }
  parts.resize(reached);
  return parts;
}

/// Finds the region of one point.
class RegionFinder {
 public:
  RegionFinder(const MapHistory& history, const Vec2& point)
      : history_(history), record_(history.record()), point_(point) {}

  std::optional<MapRegion> find() {
    intersect_covering();
    if (!subtract_others()) {
      return std::nullopt;
    }
    if (!collect_parts()) {
      return std::nullopt;  // the point is on an edge, or nothing covers it
    }
    return connected_region();
  }

 private:
  Polygon polygon_of(std::int32_t row) const {
    Polygon polygon;
    for (const Vec2& corner : record_.outline(history_.row(row))) {
      polygon.push_back({corner.x, corner.y});
    }
    return polygon;
  }

  /// Sets rest_ to the intersection of all fragments that cover the point, others_ to the rest.
  void intersect_covering() {
    for (std::int32_t k = 0; k < history_.step_count(); ++k) {
      const std::int32_t row = history_.step(k).row;
      if (row == MapRecord::no_row) {
        continue;
      }
      if (!record_.covers(history_.row(row), point_)) {
        others_.push_back(row);
        continue;
      }
      const Polygon polygon = polygon_of(row);
      if (box_.low.u > box_.high.u) {
        rest_.assign(polygon);
        box_ = box_of(polygon);
      }
      for (const PlaneRegion::Side& side : sides_of(polygon)) {
        const PlaneRegion::Side outside{-side.a, -side.b, -side.c};
        rest_.subtract({&outside, 1}, box_);
      }
    }
    box_ = {};
    rest_.for_each([&](std::span<const Point> corners) {
      for (const Point& p : corners) {
        box_.add(p);
      }
    });
  }

  /// Returns false where rest_ falls into too many parts.
  bool subtract_others() {
    for (const std::int32_t row : others_) {
      PlaneRegion::Box box;
      for (const Vec2& corner : record_.outline(history_.row(row))) {
        box.add({corner.x, corner.y});
      }
      if (!box_.overlaps(box)) {
        continue;
      }
      const auto sides = sides_of(polygon_of(row));
      if (!sides.empty()) {
        rest_.subtract(sides, box);
      }
      if (rest_.size() > max_parts) {
        return false;
      }
    }
    return true;
  }

  /// Copies the parts of rest_, the one in which the point lies deepest first. Returns false where
  /// the point lies inside none.
  bool collect_parts() {
    double deepest = 0;
    rest_.for_each([&](std::span<const Point> corners) {
      Polygon part(corners.begin(), corners.end());
      const auto sides = sides_of(part);
      double depth = sides.empty() ? -HUGE_VAL : HUGE_VAL;
      for (const PlaneRegion::Side& side : sides) {
        depth = std::min(depth, side.distance({point_.x, point_.y}));
      }
      parts_.push_back(std::move(part));
      if (depth > deepest) {
        std::swap(parts_.front(), parts_.back());
      }
      deepest = std::max(deepest, depth);
    });
    return deepest != 0;
  }

  MapRegion connected_region() {
    MapRegion region;
    const double tolerance = rounding * length_of(box_);
    for (const Polygon& part : connected_to_first(std::move(parts_), tolerance)) {
      region.area += area_of(part);
      region.parts.emplace_back();
      for (const Point& p : part) {
        region.parts.back().push_back({p.u, p.v});
      }
    }
    return region;
  }

  const MapHistory& history_;
  const MapRecord& record_;
  Vec2 point_;
  PlaneRegion rest_;
  PlaneRegion::Box box_;              ///< bounds of rest_ before the others are subtracted
  std::vector<std::int32_t> others_;  ///< rows of fragments that do not cover the point
  std::vector<Polygon> parts_;
};

}  // namespace

std::optional<MapRegion> region_at(const MapHistory& history, const Vec2& point) {
  return RegionFinder(history, point).find();
}

}  // namespace transillum
