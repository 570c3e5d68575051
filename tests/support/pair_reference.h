// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/vec3.h"

namespace transillum::testing {

/// Corners of a planar convex polygon, counter-clockwise seen from its lit side.
using ConvexPolygon = std::vector<Vec3>;

/// A_i F_ij of two polygons, from integrals in extended precision that share no code with the
/// library.
struct ReferenceExchange {
  double area = 0;      ///< m²
  double error = 0;     ///< estimate, m²
  bool reached = true;  ///< the error is as small as it should be
};

/// By adaptive quadrature over `p` of Lambert's formula for what a point sees of `q`, in numbers of
/// 64 bits. A blocker hides its projection from the point; projections that overlap are counted
/// by inclusion and exclusion.
/// @param blockers a few: the time doubles with each
/// @param relative wanted error over the area
/// @param absolute wanted error, m²; the larger of both counts
/// @param most_parts triangles of p at which it gives up
ReferenceExchange reference_exchange(const ConvexPolygon& p, const ConvexPolygon& q,
                                     const std::vector<ConvexPolygon>& blockers, double relative,
                                     double absolute, int most_parts = 200);

}  // namespace transillum::testing
