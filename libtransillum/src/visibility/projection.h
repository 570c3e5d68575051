// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// The number of the local visibility map. A patch seen at 1e-6 of its area is a needle whose
/// width takes 1e-10 of itself only with more than a double's 53 bits; x86's 64 bits are enough
/// and cost little here (decisions/0003-extended-precision.md).
using Real = long double;

/// A point of the transillumination plane.
struct PlanePoint {
  Real x = 0, y = 0;
};
inline PlanePoint operator-(const PlanePoint& a, const PlanePoint& b) {
  return {a.x - b.x, a.y - b.y};
}
inline PlanePoint operator+(const PlanePoint& a, const PlanePoint& b) {
  return {a.x + b.x, a.y + b.y};
}
inline Real cross(const PlanePoint& a, const PlanePoint& b) { return a.x * b.y - a.y * b.x; }

/// A line of the tree seen along the direction, as an oriented line of the plane.
struct PlaneLine {
  PlanePoint origin, along;

  /// Twice the area of the triangle with `along`: > 0 to the left.
  Real side(const PlanePoint& p) const { return cross(along, p - origin); }
};

/// All points and lines of a tree, projected along one direction.
///
/// Every point is projected once, and cut points are interpolated from projected ones, so what
/// meets in space meets here, to the bit or to the last place.
struct Projection {
  PlaneFrame frame;
  std::vector<PlanePoint> points;
  std::vector<PlaneLine> lines;  ///< by LineId, from the line's a to its b

  Projection(const Scene& scene, const BspTree& tree, const Vec3& omega);
};

}  // namespace transillum
