// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/container/small_vector.hpp>

#include "geometry/box_tree.h"
#include "geometry/form_factor.h"

namespace transillum {

/// The convex hull of two polygons that face each other; it contains all lines between them.
class Shaft {
 public:
  /// @param tolerance polygons that reach no deeper than this into the hull only touch it, meters.
  Shaft(const FacingPolygons& facing, double tolerance);

  /// Whether the box may reach into the hull; never false if it does.
  bool reaches(const CenteredBox& box) const;
  /// Whether the convex polygon reaches into the hull. If p or q is concave, also true for polygons
  /// that only reach into a notch.
  bool meets(Outline polygon) const;

 private:
  void add_side(const Vec3& a, const Vec3& b, const Vec3& c);

  double tolerance_;
  Corners corners_;
  CenteredBox box_;
  boost::container::small_vector<HalfSpace, 16> sides_;  ///< the hull is their intersection
};

}  // namespace transillum
