// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// The area that the projections of two fragments have in common, in square grid units, by clipping
/// one by the edges of the other in doubles.
class ConvexOverlap {
 public:
  explicit ConvexOverlap(const ProjectedFragments& projected) : projected_(projected) {}

  /// Sets the fragment whose overlaps area_with() returns.
  void set_subject(const ProjectedFragments::Fragment& fragment);
  /// Correct to rounding; at least 0, at most either fragment's area.
  double area_with(const ProjectedFragments::Fragment& other) const;

 private:
  struct Point {
    double x, y;
  };
  struct Edge {
    Point from, along;
  };
  /// Each cut of a convex polygon adds at most one corner.
  using Polygon = std::array<Point, 2 * FragmentOutlines::max_corners>;

  static std::size_t cut(const Polygon& polygon, std::size_t count, const Edge& edge,
                         Polygon& left);

  const ProjectedFragments& projected_;
  GridPoint origin_;
  double area_ = 0;
  std::vector<Edge> edges_;
};

}  // namespace transillum
