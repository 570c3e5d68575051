// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A region lies in all fragments that cover its point, which makes a convex polygon, and in none of
// the others. What they leave of the polygon falls into convex pieces; those that can be reached
// from the point through common edges are the region:
//
//      +-------+---+       the polygon, less fragment f: pieces a, b and c.
//      |   a   |f f|       From a point in a, b is reached; c is not.
//      +-----+-+f f|
//      |  b  |f f f|
//      +-----+f+---+
//      |f f f f| c |
//      +-------+---+
#include "transillum/map_region.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/plane_region.h"

namespace transillum {
namespace {

using Point = PlaneRegion::Point;
using Polygon = std::vector<Point>;

constexpr std::size_t most_pieces = 2000;
/// Shorter lengths, as a share of the polygon's, are rounding.
constexpr double rounding = 1e-9;

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Point &a = polygon[0], &b = polygon[k - 1], &c = polygon[k];
    twice += (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  }
  return std::abs(twice) / 2;
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

/// The sides of a convex polygon, counter-clockwise; none where it is too thin to have an inside,
/// or so thin that rounding has turned it over.
std::vector<PlaneRegion::Side> sides_of(const Polygon& polygon) {
  Point center;
  for (const Point& p : polygon) {
    center.u += p.u / static_cast<double>(polygon.size());
    center.v += p.v / static_cast<double>(polygon.size());
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

/// Whether two convex polygons that do not overlap have more than a point of their edges in common.
bool have_common_edge(const Polygon& one, const Polygon& other, double tolerance) {
  for (std::size_t k = 0; k < one.size(); ++k) {
    const Point &a = one[k], &b = one[(k + 1) % one.size()];
    const double length = std::hypot(b.u - a.u, b.v - a.v);
    if (length <= tolerance) {
      continue;
    }
    const Point along{(b.u - a.u) / length, (b.v - a.v) / length};
    // From a: along the edge, and off it.
    const auto seen = [&](const Point& p) {
      const Point d{p.u - a.u, p.v - a.v};
      return Point{d.u * along.u + d.v * along.v, d.v * along.u - d.u * along.v};
    };
    for (std::size_t m = 0; m < other.size(); ++m) {
      const Point c = seen(other[m]), d = seen(other[(m + 1) % other.size()]);
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

/// The pieces that can be reached from the first through common edges, the first among them.
std::vector<Polygon> reached_from_first(std::vector<Polygon> pieces, double tolerance) {
  std::vector<PlaneRegion::Box> boxes;
  for (const Polygon& piece : pieces) {
    PlaneRegion::Box box = box_of(piece);
    box.low = {box.low.u - tolerance, box.low.v - tolerance};
    boxes.push_back(box);
  }
  std::size_t reached = 1;
  for (std::size_t from = 0; from < reached; ++from) {
    for (std::size_t to = reached; to < pieces.size(); ++to) {
      if (!boxes[from].overlaps(boxes[to]) ||
          !have_common_edge(pieces[from], pieces[to], tolerance)) {
        continue;
      }
      std::swap(pieces[reached], pieces[to]);
      std::swap(boxes[reached], boxes[to]);
      ++reached;
    }
  }
  pieces.resize(reached);
  return pieces;
}

}  // namespace

std::optional<MapRegion> region_at(const MapHistory& history, const Vec2& point) {
  const MapRecord& record = history.record();
  const auto polygon_of = [&](std::int32_t row) {
    Polygon polygon;
    for (const Vec2& corner : record.outline(history.row(row))) {
      polygon.push_back({corner.x, corner.y});
    }
    return polygon;
  };
  // What all that cover the point have in common.
  PlaneRegion rest;
  PlaneRegion::Box box;
  std::vector<std::int32_t> others;
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    const std::int32_t row = history.step(k).row;
    if (row == MapRecord::no_row) {
      continue;
    }
    if (!record.covers(history.row(row), point)) {
      others.push_back(row);
      continue;
    }
    const Polygon polygon = polygon_of(row);
    if (box.low.u > box.high.u) {
      rest.assign(polygon);
      box = box_of(polygon);
    }
    for (const PlaneRegion::Side& side : sides_of(polygon)) {
      const PlaneRegion::Side outside{-side.a, -side.b, -side.c};
      rest.subtract({&outside, 1}, box);
    }
  }
  // Less all others.
  box = {};
  rest.for_each([&](std::span<const Point> corners) {
    for (const Point& p : corners) {
      box.add(p);
    }
  });
  for (const std::int32_t row : others) {
    PlaneRegion::Box its_box;
    for (const Vec2& corner : record.outline(history.row(row))) {
      its_box.add({corner.x, corner.y});
    }
    if (!box.overlaps(its_box)) {
      continue;
    }
    const auto sides = sides_of(polygon_of(row));
    if (!sides.empty()) {
      rest.subtract(sides, its_box);
    }
    if (rest.size() > most_pieces) {
      return std::nullopt;
    }
  }

  const double tolerance = rounding * length_of(box);
  std::vector<Polygon> pieces;
  double deepest = 0;
  rest.for_each([&](std::span<const Point> corners) {
    Polygon piece(corners.begin(), corners.end());
    const auto sides = sides_of(piece);
    double depth = sides.empty() ? -HUGE_VAL : HUGE_VAL;
    for (const PlaneRegion::Side& side : sides) {
      depth = std::min(depth, side.distance({point.x, point.y}));
    }
    pieces.push_back(std::move(piece));
    if (depth > deepest) {
      std::swap(pieces.front(), pieces.back());
    }
    deepest = std::max(deepest, depth);
  });
  if (deepest == 0) {
    return std::nullopt;  // on an edge, or nothing covers the point
  }

  MapRegion region;
  for (const Polygon& piece : reached_from_first(std::move(pieces), tolerance)) {
    region.area += area_of(piece);
    region.parts.emplace_back();
    for (const Point& p : piece) {
      region.parts.back().push_back({p.u, p.v});
    }
  }
  return region;
}

}  // namespace transillum
