// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/pair_reference.h"
#include "transillum/scene.h"

namespace transillum::testing {

/// A face and the convex parts that it consists of for a reference.
struct PairFace {
  std::vector<Vec3> outline;
  std::vector<ConvexPolygon> parts;  ///< the triangles of a bent face
  double bend = 0;                   ///< how far a corner was moved across the plane, m
};

/// Two faces in an adverse position, and blockers.
struct PairScene {
  std::string kind;
  PairFace p, q;
  std::vector<PairFace> blockers;

  SceneDescription description() const;  ///< faces 0 and 1 are p and q
};

/// Two random faces, one of nine kinds by the seed: in general position, near-parallel,
/// near-perpendicular, near-coplanar, with a common edge or corner up to rounding, cut by each
/// other's plane, a huge and a tiny one, two far ones. A third are concave, half are bent by 1e-16
/// to 1e-3 of their size, a quarter has coordinates rounded to floats. The same for the same seed
/// on every machine with the same C library.
PairScene random_pair(std::uint64_t seed);
/// The same with one or two blockers: between the faces, or touching the first in an edge, a corner
/// or its plane.
PairScene random_blocked_pair(std::uint64_t seed);

/// The sum of reference_exchange() over the parts.
ReferenceExchange reference_exchange(const PairScene& scene, double relative, double absolute,
                                     int most_parts = 200);

}  // namespace transillum::testing
