// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// A point of the plane near a grid point, finer than the grid.
struct FinePoint {
  GridPoint grid;
  double x = 0, y = 0;  ///< offset from `grid`, in grid units
};

/// The outlines of one direction's fragments as BoundaryView needs them where a grid unit counts:
/// corners made by the tree's cuts are where the lines of their edges meet. Each outline is
/// computed when it is first asked for.
class CutCorners {
 public:
  /// A convex outline, counter-clockwise; edge k runs from corner k to the next along a line
  /// through `from` and `to`.
  struct Edge {
    FinePoint corner, from, to;
  };

  CutCorners(const FragmentOutlines& outlines, const ProjectedFragments& projected)
      : outlines_(outlines), projected_(projected) {}

  /// Forgets the outlines of the direction before.
  void begin();

  /// Whether a fragment's corners are points of the scene.
  bool is_uncut(const ProjectedFragments::Fragment& fragment) const {
    return fragment.changed < 0 && at(outlines_.outlines, fragment.outline).plain;
  }
  /// The outline of a fragment; empty if its lines do not bound a convex polygon and its corners on
  /// the grid are not accurate enough instead. Valid until the next call.
  std::span<const Edge> outline(std::int32_t fragment);

 private:
  struct Range {
    std::uint32_t begin = 0, end = 0;
    bool known = false;
  };

  void add_grid_corners(const ProjectedFragments::Fragment& fragment);
  void add_cut_corners(const ProjectedFragments::Fragment& fragment);
  bool is_convex(std::size_t begin) const;

  const FragmentOutlines& outlines_;
  const ProjectedFragments& projected_;
  std::vector<Range> ranges_;  ///< per fragment, in edges_; empty if none was asked for
  std::vector<Edge> edges_;    ///< outlines of fragments that the tree has cut
  std::vector<Edge> plain_;    ///< outline of the last other fragment
};

}  // namespace transillum
