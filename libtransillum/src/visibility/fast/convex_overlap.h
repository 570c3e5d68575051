// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "visibility/fast/projected_fragments.h"

namespace transillum {

/// The area that two fragments of a direction have in common, in steps squared, by cutting one
/// along the edges of the other; nothing is kept of the cut.
class ConvexOverlap {
 public:
  explicit ConvexOverlap(const ProjectedFragments& projected) : projected_(projected) {}

  /// Whose overlaps are asked for.
  void set_subject(const ProjectedFragments::Fragment& fragment);
  /// To rounding; at least 0, at most either fragment's area.
  double area_with(const ProjectedFragments::Fragment& other) const;

 private:
  struct Point {
    double x, y;
  };
  struct Edge {
    Point from, along;
  };
  /// Each cut of a convex polygon adds at most a corner.
  using Polygon = std::array<Point, 2 * FragmentOutlines::max_corners>;

  static std::size_t cut(const Polygon& polygon, std::size_t count, const Edge& edge,
                         Polygon& left);

  const ProjectedFragments& projected_;
  GridPoint origin_;
  double area_ = 0;
  std::vector<Edge> edges_;
};

}  // namespace transillum
