// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Splits the projected fragments of a direction into tiles for the engine `global`, whose
// arrangements must be small. Cuts are at double coordinates, in exact arithmetic.
#include "visibility/map/plane_tiles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace transillum {
namespace {

using Point = BasicPlanePoint<Rational>;
struct Tile {
  PlaneBox box;
  std::vector<TilePolygon> polygons;

  void add(TilePolygon polygon) {
    if (!polygon.outline.empty()) {
      polygons.push_back(std::move(polygon));
    }
  }
  /// Number of polygons with an edge inside the tile. Those that fill the tile cost nothing and are
  /// not counted; a polygon of 4 corners whose box is the tile's is taken to fill it.
  std::size_t boundary_count() const {
    return static_cast<std::size_t>(
        std::count_if(polygons.begin(), polygons.end(), [this](const TilePolygon& polygon) {
          return polygon.outline.size() != 4 || polygon.box != box;
        }));
  }
};

/// A line across the plane, parallel to one of its axes.
struct TileCut {
  bool across_x;  ///< x = at; else y = at
  double at;

  const Rational& coordinate(const Point& p) const { return across_x ? p.x : p.y; }
  double low(const PlaneBox& box) const { return across_x ? box.x0 : box.y0; }
  double high(const PlaneBox& box) const { return across_x ? box.x1 : box.y1; }
};

/// At the median of the polygons' centers, across the tile's longer side.
TileCut middle_cut(const Tile& tile) {
  TileCut cut{tile.box.x1 - tile.box.x0 >= tile.box.y1 - tile.box.y0, 0};
  std::vector<double> centers;
  for (const TilePolygon& polygon : tile.polygons) {
    centers.push_back(0.5 * (cut.low(polygon.box) + cut.high(polygon.box)));
  }
  const auto middle = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
  std::nth_element(centers.begin(), middle, centers.end());
  cut.at = *middle;
  return cut;
}

/// The part of `outline` on one side of `cut`: 1, larger coordinates; -1, smaller ones.
std::vector<Point> part_of(const std::vector<Point>& outline, const TileCut& cut, int side) {
  const Rational at(cut.at);
  const auto side_of = [&](const Point& p) { return side * CGAL::compare(cut.coordinate(p), at); };
  std::vector<Point> part;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Point& a = outline[k];
    const Point& b = outline[(k + 1) % outline.size()];
    const int side_a = side_of(a), side_b = side_of(b);
    if (side_a >= 0) {
      part.push_back(a);
    }
    if (side_a * side_b >= 0) {
      continue;
    }
    const Rational &from = cut.coordinate(a), &to = cut.coordinate(b);
    const Rational t = (at - from) / (to - from);
    part.push_back(between(a, b, t));
  }
  return part;
}

/// Distributes the polygons of `tile` to the two tiles on either side of `cut`.
std::pair<Tile, Tile> split(const Tile& tile, const TileCut& cut) {
  Tile before{tile.box, {}}, beyond{tile.box, {}};
  (cut.across_x ? before.box.x1 : before.box.y1) = cut.at;
  (cut.across_x ? beyond.box.x0 : beyond.box.y0) = cut.at;
  for (const TilePolygon& polygon : tile.polygons) {
    if (cut.high(polygon.box) <= cut.at) {
      before.add(polygon);
    } else if (cut.low(polygon.box) >= cut.at) {
      beyond.add(polygon);
    } else {
      before.add(tile_polygon(polygon.rank, part_of(polygon.outline, cut, -1)));
      beyond.add(tile_polygon(polygon.rank, part_of(polygon.outline, cut, 1)));
    }
  }
  return {std::move(before), std::move(beyond)};
}

}  // namespace

TilePolygon tile_polygon(std::int32_t rank, std::vector<Point> outline) {
  PlaneBox box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Point& p : outline) {
    box.add(p);
  }
  return {rank, std::move(outline), box};
}

void for_each_tile(std::vector<TilePolygon> polygons, std::size_t max_boundaries,
                   const Cancellation& cancellation,
                   const std::function<void(const std::vector<TilePolygon>&)>& visit) {
  PlaneBox all{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const TilePolygon& polygon : polygons) {
    for (const Point& p : polygon.outline) {
      all.add(p);
    }
  }
  std::vector<Tile> open;
  open.push_back({all, std::move(polygons)});
  while (!open.empty()) {
    cancellation.throw_if_canceled();
    const Tile tile = std::move(open.back());
    open.pop_back();
    const std::size_t boundaries = tile.boundary_count();
    if (boundaries > max_boundaries) {
      auto [before, beyond] = split(tile, middle_cut(tile));
      // Where most edges end in one point, splitting does not help.
      if (std::max(before.boundary_count(), beyond.boundary_count()) < boundaries * 9 / 10) {
        open.push_back(std::move(beyond));
        open.push_back(std::move(before));
        continue;
      }
    }
    visit(tile.polygons);
  }
}

}  // namespace transillum
