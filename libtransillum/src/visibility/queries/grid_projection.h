// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// A point of the transillumination plane in whole grid units, |x|, |y| < 2^60: differences are
/// exact, and their determinants are exact in 128 bits.
struct GridPoint {
  std::int64_t x = 0, y = 0;
};

/// All points of a tree, projected along one direction and rounded to a grid of about 2^-60 of the
/// scene's size (decisions/0013-predicates.md).
struct GridProjection {
  PlaneFrame frame;
  double unit = 1;  ///< width of the grid, meters; a power of two
  std::vector<GridPoint> points;

  /// @throws Canceled
  void project(const Scene& scene, const BspTree& tree, const Vec3& omega,
               const Cancellation& cancellation);
  /// A point of space, projected as the others.
  GridPoint point_at(const Vec3& point) const;
};

}  // namespace transillum
