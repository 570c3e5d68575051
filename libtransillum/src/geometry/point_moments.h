// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>

#include "geometry/plane_region.h"
#include "transillum/vec3.h"

namespace transillum {

/// Light that an area element receives from a polygon, and from linear functions on it.
struct PointMoments {
  double one = 0;       ///< the form factor
  double u = 0, v = 0;  ///< the same integral with the coordinates u and v as factors
};

/// Integrals of 1, u and v over a polygon in the plane at distance 1 from an area element, with the
/// kernel of the form factor, cos cos / (pi r²); exact up to rounding.
///
/// With s = (u, v) the kernel is (n_d + n_u u + n_v v) / (pi (1 + |s|²)²). By Green's theorem its
/// products with 1, u and v are elementary integrals along the edges, but for the integral of
/// 1 / (1 + |s|²) over the polygon: along an edge at distance d from the origin that is
/// d / 2 ∫ ln(1 + x) / x dt, x = d² + t², which a Gauss rule gives to 1e-13.
/// @param normal of the element, in the coordinates u, v and depth; depth points to the plane. The
/// polygon is above the element's horizon.
/// @param polygon clockwise in u and v, as a front is that is seen from the element.
PointMoments point_moments(const Vec3& normal, std::span<const PlaneRegion::Point> polygon);

}  // namespace transillum
