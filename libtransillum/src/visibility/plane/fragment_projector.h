// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <utility>

#include "visibility/plane/map_polygon.h"

namespace transillum {

/// Projects fragments of the tree onto the plane, one at a time.
template <class Number>
class FragmentProjector {
 public:
  FragmentProjector(const BspTree& tree, const BasicProjection<Number>& projection)
      : tree_(tree), projection_(projection) {}

  /// Projects `fragment`. Returns false if it is seen edge-on and must be left out.
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
    return area_ > 0 && is_convex();
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

  /// Whether the outline turns left everywhere. Pieces are planar only to rounding, so the outline
  /// of one seen edge-on within rounding may not, and is left out. Right turns that are small
  /// compared with the area are ignored: nearly collinear corners may turn either way.
  bool is_convex() const {
    const std::size_t count = outline_.size();
    for (std::size_t k = 0; k < count; ++k) {
      const BasicPlanePoint<Number>& a = outline_[k].at;
      const BasicPlanePoint<Number>& b = outline_[(k + 1) % count].at;
      const BasicPlanePoint<Number>& c = outline_[(k + 2) % count].at;
      const Number turn = cross(b - a, c - b);
      if (turn >= 0) {
        continue;
      }
      const Number size = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y) +
                          (c.x - b.x) * (c.x - b.x) + (c.y - b.y) * (c.y - b.y);
      if (turn < static_cast<Number>(-1e-14) * size && -64 * turn > area_) {
        return false;
      }
    }
    return true;
  }

  const BspTree& tree_;
  const BasicProjection<Number>& projection_;
  BasicMapPolygon<Number> outline_, reversed_;
  Number area_{};
  bool front_facing_ = false;
};

}  // namespace transillum
