// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/container/small_vector.hpp>
#include <functional>
#include <span>
#include <vector>

#include "geometry/form_factor.h"
#include "geometry/plane_region.h"

namespace transillum {

/// Coordinates (u, v, depth) about a point.
struct ViewFrame {
  /// @param depth unit
  ViewFrame(const Vec3& origin, const Vec3& depth);
  Vec3 turned(const Vec3& direction) const {
    return {dot(direction, u), dot(direction, v), dot(direction, depth)};
  }
  Vec3 coordinates(const Vec3& point) const { return turned(point - origin); }

  Vec3 origin, u, v, depth;
};

/// The part of a polygon that is visible from a point past blockers, exact up to rounding: all
/// polygons are projected from the point onto the polygon's plane.
///
/// Threads: not thread-safe.
class PointView {
 public:
  /// @param polygon convex
  /// @param blockers convex; their parts in front of the polygon's plane block.
  PointView(Outline polygon, std::span<const Corners> blockers);

  /// Form factor from an area element at x to the visible part of the polygon.
  /// @param normal unit, of the element.
  /// @param tick if set, called for each blocker; may throw to abandon the query.
  double form_factor(const Vec3& x, const Vec3& normal, const std::function<void()>& tick = {});

  /// The form factor, and the same integral with the place on the polygon as a factor.
  struct Moments {
    double one = 0;  ///< form_factor(), the same bits
    Vec3 foot;       ///< the point of the polygon's plane that is nearest to x
    Vec3 first;      ///< integral of y - foot, y being the points of the visible part
  };
  Moments moments(const Vec3& x, const Vec3& normal, const std::function<void()>& tick = {});
  /// Number of blockers.
  std::size_t blocker_count() const { return blockers_.size(); }

 private:
  bool see(const Vec3& at, const std::function<void()>& tick);
  double visible_form_factor(const Vec3& turned) const;
  void subtract(const Corners& blocker, const Vec3& x);

  ViewFrame frame_;  ///< origin in the polygon's plane, depth against its normal
  Corners polygon_;
  std::vector<Corners> blockers_;
  boost::container::small_vector<PlaneRegion::Point, 12> projected_;
  std::vector<PlaneRegion::Side> sides_;
  Corners between_;
  PlaneRegion region_;
};

/// The convex parts of a convex polygon that coplanar polygons do not cover.
std::vector<Corners> uncovered(Outline polygon, const std::vector<Corners>& covers);

}  // namespace transillum
