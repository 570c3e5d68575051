// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <boost/container/small_vector.hpp>
#include <span>

#include "transillum/vec3.h"

namespace transillum {

/// Corners of a planar polygon, one after the other.
using Outline = std::span<const Vec3>;
/// The same, kept.
struct Corners : boost::container::small_vector<Vec3, 12> {
  operator Outline() const { return {data(), size()}; }
};

/// The points x of space with normal·x >= offset.
struct HalfSpace {
  Vec3 normal;  ///< unit
  double offset = 0;

  double distance(const Vec3& x) const { return dot(normal, x) - offset; }
};

Vec3 middle_of(Outline polygon);
/// Of the ball about `center` that holds the polygon, m.
double radius_about(const Vec3& center, Outline polygon);
/// The area times the unit normal from which the corners run counter-clockwise, m².
Vec3 area_vector(Outline polygon);
/// What the polygon's lit side, from which its corners run counter-clockwise, looks at.
HalfSpace lit_half_space(Outline polygon);

/// The polygon's part in `space`. Corners within `tolerance` of its border count as on it. Parts of
/// a concave polygon stay joined along the border, there and back.
Corners clipped(Outline polygon, const HalfSpace& space, double tolerance = 0);

/// Form factor of a small area at x to a polygon's lit side, with nothing between: Lambert's sum
/// over the edges of what lies above the horizon; 0 to 1.
/// @param normal unit, of the small area.
/// @param polygon of any shape, counter-clockwise seen from its lit side.
double point_form_factor(const Vec3& x, const Vec3& normal, Outline polygon);

/// The parts of two polygons that are before each other's plane: all of one sees all of the other.
/// Polygons of one plane see nothing of each other, even back to back.
struct FacingPolygons {
  FacingPolygons(Outline whole_p, Outline whole_q);
  /// Corners within `tolerance` of the other's plane count as on it.
  FacingPolygons(Outline whole_p, Outline whole_q, double tolerance);
  /// Whether they see nothing of each other.
  bool empty() const { return p.empty() || q.empty(); }

  HalfSpace before_p, before_q;
  Corners p, q;
};

/// A_i F_ij = A_j F_ji of two polygons with nothing between, m²; exact but for rounding, some 1e-13
/// of the product of their sizes. They may touch; what is behind the other's plane takes no part.
///
/// By Stokes' theorem it is (1 / 2 pi) times the sum over pairs of edges of their direction's
/// cosine times the integral of ln r along both. Edges of one plane have an elementary integral;
/// for skew ones the outer integral is taken by Gauss' rule, on steps that shrink toward
/// singularities (decisions/0020-exact-form-factors.md).
double polygon_exchange(const FacingPolygons& facing);
inline double polygon_exchange(Outline p, Outline q) { return polygon_exchange({p, q}); }

}  // namespace transillum
