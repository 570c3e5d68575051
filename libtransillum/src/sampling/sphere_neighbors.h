// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "transillum/vec3.h"

namespace transillum {

/// The neighbors of points of the unit sphere: for each point the others nearer than a radius.
class SphereNeighbors {
 public:
  /// Lists the neighbors of the first `listed` points among all. O(N log N) for evenly spread
  /// points and a radius of a few spacings.
  SphereNeighbors(std::span<const Vec3> points, std::size_t listed, double radius);

  /// Numbers of the neighbors of point i < listed, in an order that depends on the points only.
  std::span<const std::uint32_t> of(std::size_t i) const {
    return std::span(near_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
  }

 private:
  int cell(double x) const;
  std::int64_t key(int x, int y, int z) const;
  void append_near(std::span<const Vec3> points, std::size_t i, double radius);

  int cells_;  ///< along each side of the cube [-1,1]³; at least as wide as the radius
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;  ///< cell and number of each point
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> near_;
};

}  // namespace transillum
