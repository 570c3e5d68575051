// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/container/small_vector.hpp>

#include "geometry/box_tree.h"
#include "geometry/form_factor.h"

namespace transillum {

/// The convex hull of two polygons that look at each other: all lines between them run in it.
class Shaft {
 public:
  /// @param tolerance what reaches no deeper than this into the hull only touches it, meters.
  Shaft(const FacingPolygons& facing, double tolerance);

  /// False where the box is surely outside.
  bool reaches(const CenteredBox& box) const;
  /// Whether the convex polygon reaches into the hull. For concave p or q it may say so of what
  /// only reaches into a notch.
  bool meets(Outline polygon) const;

 private:
  void add_side(const Vec3& a, const Vec3& b, const Vec3& c);

  double tolerance_;
  Corners corners_;
  CenteredBox box_;
  boost::container::small_vector<HalfSpace, 16> sides_;  ///< the hull is before all
};

}  // namespace transillum
