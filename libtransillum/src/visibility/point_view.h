// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "geometry/form_factor.h"
#include "geometry/plane_region.h"

namespace transillum {

/// What a point sees of a polygon behind others, exactly but for rounding: all are projected
/// from the point on the polygon's plane.
///
/// Threads: one at a time.
class PointView {
 public:
  /// Form factor of a small area at x to what the blockers leave of a polygon.
  /// @param normal unit, of the small area.
  /// @param polygon convex, with x before it.
  /// @param blockers convex; the parts of them that are between x and the polygon's plane block.
  double form_factor(const Vec3& x, const Vec3& normal, Outline polygon,
                     const std::vector<Corners>& blockers);

 private:
  PlaneRegion region_;
};

/// Takes away from a convex polygon what others, of the same plane, cover of it.
std::vector<Corners> uncovered(Outline polygon, const std::vector<Corners>& covers);

}  // namespace transillum
