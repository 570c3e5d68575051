// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/container/small_vector.hpp>

#include "geometry/box_tree.h"
#include "geometry/form_factor.h"

namespace transillum {

/// Largest distance of the corners of two polygons from the planes of these, m.
struct Bends {
  double p = 0, q = 0;
};

/// The convex hull of two polygons that face each other; it contains all lines between them.
class Shaft {
 public:
  /// @param tolerance polygons that reach no deeper than this into the hull only touch it, meters.
  /// @param bends deviations of p and of q from their planes: what reaches no farther in front of
  /// one of them is in its plane, m.
  Shaft(const FacingPolygons& facing, double tolerance, const Bends& bends = {});

  /// Whether the box may reach into the hull; never false if it does.
  bool reaches(const CenteredBox& box) const;
  /// Whether the convex polygon reaches into the hull. If p or q is concave, also true for polygons
  /// that only reach into a notch.
  /// @param bend deviation of the polygon from its plane, m.
  bool meets(Outline polygon, double bend = 0) const;

 private:
  bool is_in_front_of(const HalfSpace& back, double bend) const;
  void add_side(const Vec3& a, const Vec3& b, const Vec3& c);

  double tolerance_;
  Bends bends_;
  Corners corners_;   ///< corners of p, then of q
  std::size_t of_p_;  ///< number of corners of p
  CenteredBox box_;
  boost::container::small_vector<HalfSpace, 16> sides_;  ///< the hull is their intersection
};

}  // namespace transillum
