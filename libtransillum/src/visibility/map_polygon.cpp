// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/map_polygon.h"

#include <algorithm>

namespace transillum {

Real area_of(const MapPolygon& polygon) {
  Real twice = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    twice += cross(polygon[k - 1].at - polygon[0].at, polygon[k].at - polygon[0].at);
  }
  return twice / 2;
}

/// Sides of all corners of `polygon` against the line of `edge`. Corners of an edge on that very
/// line are on it by definition: what a determinant of nearly equal points says is noise.
void MapClipper::measure_sides(const MapPolygon& polygon, const MapCorner& edge) {
  const PlaneLine& line = projection_.lines[static_cast<std::size_t>(edge.line)];
  const std::size_t count = polygon.size();
  sides_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Real side = line.side(polygon[k].at);
    sides_[k] = edge.forward ? side : -side;
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (polygon[k].line == edge.line) sides_[k] = sides_[(k + 1) % count] = 0;
  }
}

/// Whether the line of some edge of `by` has all of `other` on its outer side.
bool MapClipper::separated(const MapPolygon& by, const MapPolygon& other) {
  const auto inside_of = [&](const MapCorner& edge) {
    const PlaneLine& line = projection_.lines[static_cast<std::size_t>(edge.line)];
    const MapCorner* before = &other.back();
    for (const MapCorner& corner : other) {
      const bool on_line = corner.line == edge.line || before->line == edge.line;
      before = &corner;
      if (on_line) continue;
      const Real side = line.side(corner.at);
      if (edge.forward ? side > 0 : side < 0) return true;
    }
    return false;
  };
  return !std::all_of(by.begin(), by.end(), inside_of);
}

bool MapClipper::clip(const MapPolygon& subject, const MapPolygon& window) {
  if (separated(window, subject) || separated(subject, window)) return false;
  inside_ = subject;
  outside_count_ = 0;
  for (const MapCorner& edge : window) {
    measure_sides(inside_, edge);
    bool any_inside = false, any_outside = false;
    for (const Real s : sides_) {
      any_inside |= s > 0;
      any_outside |= s < 0;
    }
    if (!any_inside) return false;  // they overlapped by rounding only
    if (any_outside) split(edge);
  }
  inside_area_ = area_of(inside_);
  return inside_area_ > 0;
}

/// Splits inside_ along `edge`, of which sides_ tells: what lies outside becomes a part of its
/// own, and both get an edge on the line of `edge`.
void MapClipper::split(const MapCorner& edge) {
  if (outside_.size() == outside_count_) outside_.emplace_back();
  MapPolygon& out = outside_[outside_count_++];
  out.clear();
  kept_.clear();
  const std::size_t count = inside_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const MapCorner& corner = inside_[k];
    const Real here = sides_[k];
    const Real there = sides_[(k + 1) % count];
    if (here >= 0) kept_.push_back(corner);
    if (here <= 0) out.push_back(corner);
    if (here == 0) {
      // Leaving from a corner on the line, or coming back to one.
      if (there < 0) {
        kept_.back().line = edge.line;
        kept_.back().forward = edge.forward;
      } else if (there > 0) {
        out.back().line = edge.line;
        out.back().forward = !edge.forward;
      }
      continue;
    }
    if (!((here > 0 && there < 0) || (here < 0 && there > 0))) continue;
    const PlanePoint& a = corner.at;
    const PlanePoint& b = inside_[(k + 1) % count].at;
    const Real t = here / (here - there);
    const PlanePoint x{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
    MapCorner crossing{x, corner.line, corner.forward};
    MapCorner closing{x, edge.line, edge.forward};
    if (here > 0) {
      kept_.push_back(closing);
      out.push_back(crossing);
    } else {
      closing.forward = !edge.forward;
      out.push_back(closing);
      kept_.push_back(crossing);
    }
  }
  inside_.swap(kept_);
}

}  // namespace transillum
