// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/convex_overlap.h"

#include <algorithm>

#include "geometry/polygon_area.h"

namespace transillum {

void ConvexOverlap::set_subject(const ProjectedFragments::Fragment& fragment) {
  origin_ = projected_.corners[fragment.begin];
  area_ = fragment.area;
  edges_.clear();
  for (std::uint32_t k = fragment.begin; k < fragment.end; ++k) {
    const GridPoint& a = projected_.corners[k];
    const GridPoint& b = projected_.corners[k + 1 < fragment.end ? k + 1 : fragment.begin];
    edges_.push_back({{static_cast<double>(a.x - origin_.x), static_cast<double>(a.y - origin_.y)},
                      {static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y)}});
  }
}

double ConvexOverlap::area_with(const ProjectedFragments::Fragment& other) const {
  Polygon polygon, left;
  std::size_t count = other.end - other.begin;
  for (std::size_t k = 0; k < count; ++k) {
    const GridPoint& p = projected_.corners[other.begin + k];
    polygon[k] = {static_cast<double>(p.x - origin_.x), static_cast<double>(p.y - origin_.y)};
  }
  for (const Edge& edge : edges_) {
    count = cut(polygon, count, edge, left);
    if (count < 3) {
      return 0;
    }
    std::swap(polygon, left);
  }
  const double area =
      polygon_area(count, [&](std::size_t k) -> const Point& { return polygon[k]; });
  return std::clamp(area, 0.0, std::min(area_, other.area));
}

/// Clips a polygon of `count` corners to the left side of an edge; returns the number of corners in
/// `left`.
std::size_t ConvexOverlap::cut(const Polygon& polygon, std::size_t count, const Edge& edge,
                               Polygon& left) {
  const auto side = [&edge](const Point& p) {
    return edge.along.x * (p.y - edge.from.y) - edge.along.y * (p.x - edge.from.x);
  };
  std::size_t kept = 0;
  Point before = polygon[count - 1];
  double side_before = side(before);
  for (std::size_t k = 0; k < count; ++k) {
    const Point& here = polygon[k];
    const double side_here = side(here);
    if ((side_before < 0 && side_here > 0) || (side_before > 0 && side_here < 0)) {
      const double t = side_before / (side_before - side_here);
      if (kept == left.size()) {
        return 0;  // only rounding can make that many corners
      }
      left[kept++] = {before.x + t * (here.x - before.x), before.y + t * (here.y - before.y)};
    }
    if (side_here >= 0) {
      if (kept == left.size()) {
        return 0;
      }
      left[kept++] = here;
    }
    before = here;
    side_before = side_here;
  }
  return kept;
}

}  // namespace transillum
