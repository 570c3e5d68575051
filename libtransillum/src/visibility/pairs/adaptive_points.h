// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "geometry/form_factor.h"

namespace transillum {

/// The exchange of a convex polygon with another one, by points, more of them where what they see
/// changes most: at the edge of a shadow, or in a strip along an edge.
class AdaptivePoints {
 public:
  /// The exchange of a triangle by its points, and what it would be if its corners decided, m².
  struct Seen {
    double by_points, by_corners;
  };
  using See = std::function<Seen(Outline triangle)>;
  /// The error that is tolerated where `seen` is seen, m².
  using Tolerated = std::function<double(double seen)>;

  /// @param see called for each triangle
  AdaptivePoints(See see, Tolerated tolerated)
      : see_(std::move(see)), tolerated_(std::move(tolerated)) {}

  /// The exchange of a polygon, m².
  /// @param divisions about how many of the first triangles lie side by side along the polygon
  double operator()(Outline polygon, int divisions);

 private:
  struct Triangle {
    std::array<Vec3, 3> corners;
    double seen;   ///< by points
    double doubt;  ///< by how much it may be wrong, as far as corners and larger triangles tell
  };
  void add(const std::array<Vec3, 3>& triangle, int bisections);
  void divide(std::size_t number);
  void divide_doubtful(double doubt);

  See see_;
  Tolerated tolerated_;
  std::vector<Triangle> triangles_;
};

}  // namespace transillum
