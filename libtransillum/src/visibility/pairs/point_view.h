// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/container/small_vector.hpp>
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

/// What points see of a polygon behind others, exactly but for rounding: all is projected from a
/// point on the polygon's plane.
///
/// Threads: one at a time.
class PointView {
 public:
  /// @param polygon convex
  /// @param blockers convex; what of them is before the polygon's plane blocks.
  PointView(Outline polygon, std::span<const Corners> blockers);

  /// Form factor of a small area at x to what the blockers leave of the polygon.
  /// @param normal unit, of the small area.
  double form_factor(const Vec3& x, const Vec3& normal);

 private:
  void take_away(const Corners& blocker, const Vec3& x);

  ViewFrame frame_;  ///< in the polygon's plane, looking at it
  Corners polygon_;
  std::vector<Corners> blockers_;
  boost::container::small_vector<PlaneRegion::Point, 12> projected_;
  std::vector<PlaneRegion::Side> sides_;
  Corners between_;
  PlaneRegion region_;
};

/// Takes away from a convex polygon what others, of the same plane, cover of it.
std::vector<Corners> uncovered(Outline polygon, const std::vector<Corners>& covers);

}  // namespace transillum
