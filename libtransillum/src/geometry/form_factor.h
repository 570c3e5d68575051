// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Form factors of polygons in closed form, without visibility: from a point, and between two
// polygons. For the first shot and exact form factors, which pass it the visible parts.
#pragma once

#include <boost/container/small_vector.hpp>
#include <span>

#include "transillum/vec3.h"

namespace transillum {

/// Corners of a planar polygon, in order.
using Outline = std::span<const Vec3>;
/// The corners of an Outline, owned. Pointers are its iterators, so that std::span takes it as a
/// range; Boost's own iterators are contiguous for the standard library in some versions only.
struct Corners : boost::container::small_vector<Vec3, 12> {
  const Vec3* begin() const { return data(); }
  const Vec3* end() const { return data() + size(); }
  Vec3* begin() { return data(); }
  Vec3* end() { return data() + size(); }
};

/// The points x of space with normal·x >= offset.
struct HalfSpace {
  Vec3 normal;        ///< unit
  double offset = 0;  ///< m

  /// Signed distance from the border, > 0 inside, m.
  double distance(const Vec3& x) const { return dot(normal, x) - offset; }
};

/// The mean of the corners, m.
Vec3 middle_of(Outline polygon);
/// Radius of the smallest ball about `center` that contains the polygon, m.
double radius_about(const Vec3& center, Outline polygon);
/// The area times the unit normal of the side from which the corners run counter-clockwise, m².
Vec3 area_vector(Outline polygon);
/// The half-space in front of the polygon: on the side from which its corners run
/// counter-clockwise.
HalfSpace lit_half_space(Outline polygon);

/// The part of a polygon in `space`. Corners within `tolerance` of the border are treated as on it.
/// Parts of a concave polygon stay connected by edges along the border.
Corners clipped(Outline polygon, const HalfSpace& space, double tolerance = 0);

/// Form factor from a differential area at x to the front side of a polygon with nothing between,
/// by Lambert's sum over the edges of the part above the horizon; 0 to 1.
/// @param x position of the differential area.
/// @param normal its unit normal.
/// @param polygon of any shape, counter-clockwise seen from its front side.
double point_form_factor(const Vec3& x, const Vec3& normal, Outline polygon);

/// The parts of two polygons that lie in front of each other's plane: every point of one sees every
/// point of the other. Coplanar polygons see nothing of each other, even back to back.
struct FacingPolygons {
  /// With a tolerance for the rounding of the coordinates.
  FacingPolygons(Outline whole_p, Outline whole_q);
  /// Corners within `tolerance` of the other's plane are treated as on it.
  FacingPolygons(Outline whole_p, Outline whole_q, double tolerance);
  /// The same with the half-spaces in front of both, if these are known.
  FacingPolygons(Outline whole_p, const HalfSpace& front_p, Outline whole_q,
                 const HalfSpace& front_q, double tolerance);
  /// Whether they see nothing of each other.
  bool empty() const { return p.empty() || q.empty(); }

  HalfSpace before_p;  ///< in front of the first polygon
  HalfSpace before_q;  ///< in front of the second polygon
  Corners p;           ///< part of the first in before_q
  Corners q;           ///< part of the second in before_p
};

/// A_i F_ij = A_j F_ji of two polygons with nothing between, m²; exact up to rounding, about 1e-13
/// of the product of their sizes. They may touch; parts behind the other's plane do not contribute.
///
/// By Stokes' theorem it is 1 / (2 pi) times the sum, over pairs of edges, of the cosine between
/// them times the integral of ln r along both. For coplanar edges the integral is elementary; for
/// skew ones the outer integral uses Gauss' rule on intervals that shrink toward singularities
/// (decisions/0020-exact-form-factors.md). Where that sum would cancel, the form factor from points
/// of one of them is integrated numerically: polygons small against their distance, or almost in
/// one plane.
/// @param integrated if set, is set to whether it was integrated numerically
double polygon_exchange(const FacingPolygons& facing, bool* integrated = nullptr);
inline double polygon_exchange(Outline p, Outline q) { return polygon_exchange({p, q}); }

}  // namespace transillum
