// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/vec3.h"

namespace transillum {

/// How points are moved: scaled and turned about a point, then translated. A placement that only
/// translates adds `move` to each point; turns by multiples of 90 degrees are exact.
struct FacePlacement {
  Vec3 move = {};          ///< translation, m
  Vec3 turn = {};          ///< degrees about x, then y, then z
  Vec3 scale = {1, 1, 1};  ///< factors along x, y and z before the turn, > 0

  /// Exact comparison of all members.
  friend bool operator==(const FacePlacement&, const FacePlacement&) = default;
};

/// A coordinate axis: 0 is x, 1 is y, 2 is z.
Vec3 unit_of_axis(int axis);
/// Coordinate number `axis` of a vector.
double& coordinate(Vec3& v, int axis);
/// Coordinate number `axis` of a vector.
double coordinate(const Vec3& v, int axis);

/// The vector after the turn of a placement.
Vec3 turned(const Vec3& v, const Vec3& turn);
/// The turn that is first `turn` and then an angle about a coordinate axis, degrees.
Vec3 turned_further(const Vec3& turn, int axis, double degrees);
/// Where a placement about `pivot` moves a point.
Vec3 placed(const Vec3& point, const Vec3& pivot, const FacePlacement& placement);

}  // namespace transillum
