// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Convex polygons of the transillumination plane and their clipping, shared by the visibility maps
// in long double and in exact numbers. Edges refer to lines of the BSP tree, so that both sides of
// a cut are clipped by the same line.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/polygon_area.h"
#include "visibility/plane/projection.h"

namespace transillum {

/// A corner of a polygon of the map, and the line of the BSP tree on which the edge to the next
/// corner lies, however that edge has been shortened by cuts.
template <class Number>
struct BasicMapCorner {
  BasicPlanePoint<Number> at;
  LineId line;
  bool forward;  ///< the edge runs along its line from a to b
};
using MapCorner = BasicMapCorner<Real>;

/// A convex polygon of the map, counter-clockwise.
template <class Number>
using BasicMapPolygon = std::vector<BasicMapCorner<Number>>;
using MapPolygon = BasicMapPolygon<Real>;

/// Area, by the shoelace formula relative to the first corner, so that small polygons far from the
/// origin keep their digits.
template <class Number>
Number area_of(const std::vector<BasicMapCorner<Number>>& polygon) {
  return polygon_area(polygon.size(), [&](std::size_t k) -> const auto& { return polygon[k].at; });
}

/// Clips convex polygons against each other by the lines of their edges.
template <class Number>
class BasicMapClipper {
 public:
  using Corner = BasicMapCorner<Number>;
  using Polygon = BasicMapPolygon<Number>;

  explicit BasicMapClipper(const BasicProjection<Number>& projection) : projection_(projection) {}

  /// Splits `subject` into the part inside `window`, available as inside(), and parts outside,
  /// available as outside(0) … outside(outside_count() - 1). Returns false if the two have no
  /// common area; the parts are then unspecified.
  bool clip(const Polygon& subject, const Polygon& window) {
    if (separated(window, subject) || separated(subject, window)) {
      return false;
    }
    inside_ = subject;
    outside_count_ = 0;
    for (const Corner& edge : window) {
      measure_sides(inside_, edge);
      bool any_inside = false, any_outside = false;
      for (const Number& s : sides_) {
        any_inside |= s > 0;
        any_outside |= s < 0;
      }
      if (!any_inside) {
        return false;  // overlap by rounding only
      }
      if (any_outside) {
        split(edge);
      }
    }
    inside_area_ = area_of(inside_);
    return inside_area_ > 0;
  }

  const Polygon& inside() const { return inside_; }
  const Number& inside_area() const { return inside_area_; }
  std::size_t outside_count() const { return outside_count_; }
  const Polygon& outside(std::size_t k) const { return outside_[k]; }

 private:
  /// Whether the line of some edge of `by` has all of `other` on its outer side.
  bool separated(const Polygon& by, const Polygon& other) {
    const auto inside_of = [&](const Corner& edge) {
      const BasicPlaneLine<Number>& line = projection_.line(edge.line);
      const Corner* before = &other.back();
      for (const Corner& corner : other) {
        const bool on_line = corner.line == edge.line || before->line == edge.line;
        before = &corner;
        if (on_line) {
          continue;
        }
        const Number side = line.side(corner.at);
        if (edge.forward ? side > 0 : side < 0) {
          return true;
        }
      }
      return false;
    };
    return !std::all_of(by.begin(), by.end(), inside_of);
  }

  /// Computes the sides of all corners of `polygon` relative to the line of `edge`. Corners of an
  /// edge on the same line are on it by definition: the determinant of nearly equal points is
  /// noise.
  void measure_sides(const Polygon& polygon, const Corner& edge) {
    const BasicPlaneLine<Number>& line = projection_.line(edge.line);
    const std::size_t count = polygon.size();
    sides_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Number side = line.side(polygon[k].at);
      sides_[k] = edge.forward ? side : -side;
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (polygon[k].line == edge.line) {
        sides_[k] = sides_[(k + 1) % count] = 0;
      }
    }
  }

  /// Splits inside_ along the line of `edge`, by sides_: the part outside is added to outside_, and
  /// both parts get an edge on that line.
  void split(const Corner& edge) {
    if (outside_.size() == outside_count_) {
      outside_.emplace_back();
    }
    Polygon& out = outside_[outside_count_++];
    out.clear();
    kept_.clear();
    const std::size_t count = inside_.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Corner& corner = inside_[k];
      const Number& here = sides_[k];
      const Number& there = sides_[(k + 1) % count];
      if (here >= 0) {
        kept_.push_back(corner);
      }
      if (here <= 0) {
        out.push_back(corner);
      }
      if (here == 0) {
        // The outline leaves or reaches the inner side at a corner on the line.
        if (there < 0) {
          kept_.back().line = edge.line;
          kept_.back().forward = edge.forward;
        } else if (there > 0) {
          out.back().line = edge.line;
          out.back().forward = !edge.forward;
        }
        continue;
      }
      if (!((here > 0 && there < 0) || (here < 0 && there > 0))) {
        continue;
      }
      const Number t = here / (here - there);
      const BasicPlanePoint<Number> x = between(corner.at, inside_[(k + 1) % count].at, t);
      Corner crossing{x, corner.line, corner.forward};
      Corner closing{x, edge.line, edge.forward};
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

  const BasicProjection<Number>& projection_;
  Polygon inside_, kept_;
  std::vector<Polygon> outside_;
  std::size_t outside_count_ = 0;
  Number inside_area_{};
  std::vector<Number> sides_;  ///< sides of the corners given to measure_sides(), > 0 inside
};
using MapClipper = BasicMapClipper<Real>;

}  // namespace transillum
