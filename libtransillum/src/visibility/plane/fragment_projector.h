// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>

#include "visibility/plane/map_polygon.h"

namespace transillum {

/// Projects fragments of the tree onto the plane, one at a time.
template <class Number>
class FragmentProjector {
 public:
  FragmentProjector(const BspTree& tree, const BasicProjection<Number>& projection)
      : tree_(tree), projection_(projection) {}

  /// Projects `fragment`. Returns false if it is seen edge-on and must be omitted.
  bool project(const BspTree::Fragment& fragment) {
    outline_.clear();
    for (const BspTree::Corner& corner : tree_.corners(fragment)) {
      outline_.push_back({projection_.point(corner.point), corner.line, corner.forward});
    }
    area_ = area_of(outline_);
    front_facing_ = area_ > 0;
    if (!front_facing_) {
      reverse();
      area_ = -area_;
    }
    return area_ > 0 && make_convex();
  }

  const BasicMapPolygon<Number>& outline() const { return outline_; }
  const Number& area() const { return area_; }
  bool front_facing() const { return front_facing_; }

 private:
  /// Reverses a clockwise outline: the edge that left a corner now arrives there.
  void reverse() {
    const std::size_t count = outline_.size();
    reversed_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const BasicMapCorner<Number>& corner = outline_[count - 1 - k];
      const BasicMapCorner<Number>& before = outline_[(2 * count - 2 - k) % count];
      reversed_[k] = {corner.at, before.line, !before.forward};
    }
    outline_.swap(reversed_);
  }

  /// Makes the outline turn left everywhere; returns whether that is possible. Pieces are planar
  /// only to rounding, so the outline of one seen edge-on within rounding may not turn left, and is
  /// omitted. Where right turns are small compared with the area, an edge is removed that has the
  /// outline on its outer side: seen along its length, its direction is rounding. Right turns of
  /// nearly collinear corners are kept.
  bool make_convex() {
    for (std::size_t k = 0; k < outline_.size();) {
      const std::size_t count = outline_.size();
      const BasicPlanePoint<Number>& a = outline_[k].at;
      const BasicPlanePoint<Number>& b = outline_[(k + 1) % count].at;
      const BasicPlanePoint<Number>& c = outline_[(k + 2) % count].at;
      const Number turn = cross(b - a, c - b);
      if (turn >= 0) {
        ++k;
        continue;
      }
      const Number before = square(b - a), after = square(c - b);
      if (turn >= static_cast<Number>(-1e-14) * (before + after)) {
        ++k;
        continue;
      }
      if (-64 * turn > area_ || count == 3) {
        return false;
      }
      const std::size_t shorter = before < after ? k : (k + 1) % count;
      if (!is_turned(shorter)) {
        ++k;
        continue;
      }
      remove_edge(shorter, before < after);
      area_ = area_of(outline_);
      k = 0;
    }
    return area_ > 0;
  }

  /// Whether the outline lies on the outer side of an edge's line rather than on the inner side.
  bool is_turned(std::size_t k) const {
    const BasicPlanePoint<Number>& a = outline_[k].at;
    const BasicPlanePoint<Number> along = outline_[(k + 1) % outline_.size()].at - a;
    Number inside{}, outside{};
    for (const BasicMapCorner<Number>& corner : outline_) {
      const Number side = cross(along, corner.at - a);
      inside = std::max(inside, side);
      outside = std::max<Number>(outside, -side);
    }
    return outside > inside;
  }

  static Number square(const BasicPlanePoint<Number>& v) { return v.x * v.x + v.y * v.y; }

  /// Removes the edge from corner k to the next, and the one of these that is not kept.
  void remove_edge(std::size_t k, bool keep_start) {
    const std::size_t next = k + 1 < outline_.size() ? k + 1 : 0;
    if (keep_start) {
      outline_[next].at = outline_[k].at;
    }
    outline_.erase(outline_.begin() + static_cast<std::ptrdiff_t>(k));
  }

  const BspTree& tree_;
  const BasicProjection<Number>& projection_;
  BasicMapPolygon<Number> outline_, reversed_;
  Number area_{};
  bool front_facing_ = false;
};

}  // namespace transillum
