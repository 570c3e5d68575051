// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/vec3.h"

namespace transillum {

/// A directed line segment.
struct Edge {
  Edge(const Vec3& from, const Vec3& to)
      : begin(from), end(to), length(norm(to - from)), direction((to - from) / length) {}

  /// The point at distance s from `begin`.
  Vec3 at(double s) const { return begin + s * direction; }

  Vec3 begin;      ///< m
  Vec3 end;        ///< m
  double length;   ///< m
  Vec3 direction;  ///< unit; not finite where the length is 0
};

/// The cosine between two edges times the double integral of ln r along both, where r is the
/// distance of their points; 0 for an edge of length 0. The edges may touch, cross or coincide.
double edge_pair_integral(const Edge& a, const Edge& b);

}  // namespace transillum
