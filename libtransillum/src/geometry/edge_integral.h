// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/vec3.h"

namespace transillum {

/// A segment from `begin`, `length` along `direction`.
struct Edge {
  Edge(const Vec3& from, const Vec3& to)
      : begin(from), end(to), length(norm(to - from)), direction((to - from) / length) {}

  Vec3 at(double s) const { return begin + s * direction; }

  Vec3 begin, end;
  double length;
  Vec3 direction;  ///< unit; not finite where the length is 0
};

/// The cosine between two edges times the integral of ln r along both, r the distance of their
/// points; 0 for an edge without length. They may touch, cross or coincide.
double edge_pair_integral(const Edge& a, const Edge& b);

}  // namespace transillum
