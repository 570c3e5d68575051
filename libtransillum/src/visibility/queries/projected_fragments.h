// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The input of engines fast and corrected for one direction: the fragments of the BSP tree,
// projected onto the integer grid of the transillumination plane, in BSP order. FragmentOutlines is
// made once per tree, ProjectedFragments once per direction.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "visibility/queries/exact_side.h"
#include "visibility/queries/grid_projection.h"
#include "visibility/queries/patch_shaft.h"

namespace transillum {

/// The outlines of a tree's fragments with at most max_corners corners each: a fragment with more
/// is cut along diagonals into several outlines. Independent of the direction.
struct FragmentOutlines {
  static constexpr std::size_t max_corners = 16;
  static constexpr PointId no_point = -1;
  struct Outline {
    PatchId patch;
    std::uint32_t begin, end;  ///< in `corners`
    bool plain;                ///< each edge's line is defined by the edge's own two corners
  };
  struct Corner {
    PointId point;
    LineId line;   ///< line of the edge to the next corner
    bool forward;  ///< that edge runs along its line from a to b
    bool exact;    ///< the corner is a defining point of both its edges' lines
  };
  std::vector<BspTree::Line> lines;  ///< the tree's, then the diagonals
  std::vector<Corner> corners;
  std::vector<Outline> outlines;
  std::vector<std::uint32_t> first;  ///< first outline of each fragment; one more at the end
  /// Successive triangles of a patch, uncut, that are one convex polygon but for rounding, such as
  /// those of a face that is planar only within the rounding of its file
  /// (decisions/0048-precision-of-files.md).
  struct Join {
    FragmentId first, last;
    std::uint32_t outline;  ///< outline of the polygon
  };
  std::vector<Join> joins;
  double median_area = 0;  ///< median_area_of()
  /// Per patch that stands for several: the area of the smallest, relative to it. If it is empty,
  /// no patch does.
  std::vector<double> smallest_part;
  std::vector<std::int32_t> join_of;  ///< per fragment: in `joins`, or -1; empty if there are none

  /// @param scene of the tree.
  FragmentOutlines(const Scene& scene, const BspTree& tree);
  /// Median area of the patches, square meters; 0 without patches.
  static double median_area_of(const Scene& scene);

 private:
  void add(PatchId patch, const std::vector<BspTree::Corner>& part);
  void join_triangles(const Scene& scene, const BspTree& tree);
};

/// Bounds along x, y, x + y and x - y, in grid units, rounded outward: the four lower bounds, then
/// the four upper bounds negated.
struct alignas(16) FragmentBox {
  std::array<float, 8> ends;
};
/// The same bounds in the form that is compared with a FragmentBox: upper bounds first, then the
/// lower bounds negated.
struct alignas(16) FragmentWindow {
  std::array<float, 8> ends;

  void add(const FragmentWindow& other) {
#ifdef __SSE2__
    for (std::size_t d = 0; d < 8; d += 4) {
      _mm_store_ps(ends.data() + d,
                   _mm_max_ps(_mm_load_ps(ends.data() + d), _mm_load_ps(other.ends.data() + d)));
    }
#else
    for (std::size_t d = 0; d < 8; ++d) {
      ends[d] = std::max(ends[d], other.ends[d]);
    }
#endif
  }
  bool overlaps(const FragmentBox& box) const {
#ifdef __SSE2__
    const __m128 low = _mm_cmplt_ps(_mm_load_ps(box.ends.data()), _mm_load_ps(ends.data()));
    const __m128 high =
        _mm_cmplt_ps(_mm_load_ps(box.ends.data() + 4), _mm_load_ps(ends.data() + 4));
    return _mm_movemask_ps(_mm_and_ps(low, high)) == 15;
#else
    bool all = true;
    for (std::size_t d = 0; d < 8; ++d) {
      all &= box.ends[d] < ends[d];
    }
    return all;
#endif
  }
};
/// The window with the bounds of a box.
inline FragmentWindow window_of(const FragmentBox& box) {
  FragmentWindow window;
  for (std::size_t d = 0; d < 4; ++d) {
    window.ends[d] = -box.ends[d + 4];
    window.ends[d + 4] = -box.ends[d];
  }
  return window;
}
/// A float that is no larger than a number of grid units.
inline float rounded_down(double units) {
  return static_cast<float>(units - 0x1p-23 * std::abs(units) - 1);
}

inline float rounded_up(double units) {
  return static_cast<float>(units + 0x1p-23 * std::abs(units) + 1);
}

/// All fragments of a tree projected along one direction, in BSP order: those farthest toward omega
/// first. Fragments seen edge-on are omitted; a fragment with more than
/// FragmentOutlines::max_corners corners is several here, one per outline.
struct ProjectedFragments {
  struct Fragment {
    std::uint32_t begin, end;  ///< in `corners`
    std::uint32_t outline;     ///< its outline, whose order of corners is reversed if not `front`
    PatchId patch;
    bool front;       ///< front-facing: it receives for omega
    bool cut_needle;  ///< cut by the tree so thin that its corners are off their lines by more than
                      ///< accuracy allows: see position_of()
    std::int32_t changed;  ///< first of its own corners in changed_corners_, or -1: the outline's
    double area;           ///< area of the projection, in square grid units; > 0
  };
  /// Errors of areas, relative to patch_area(), must be below this.
  static constexpr double accuracy = 0x1p-37;

  GridProjection grid;
  std::vector<FragmentBox> boxes;  ///< per fragment
  std::vector<Fragment> fragments;
  std::vector<GridPoint> corners;  ///< counter-clockwise; corners made by a cut of the tree are off
                                   ///< their lines by up to a grid unit

  /// Replaces the contents by the fragments for `omega`; if `shaft` is given, only by those that it
  /// may hold.
  /// @throws Canceled
  void project(const Scene& scene, const BspTree& tree, const FragmentOutlines& outlines,
               const Vec3& omega, const Cancellation& cancellation,
               const PatchShaft* shaft = nullptr);

  /// The projected area of a patch, but not more than half of the patches have, in square grid
  /// units: errors of a large patch count for the small ones that it sees.
  double patch_area(PatchId patch) const {
    const Patch& p = scene_->patch(patch);
    return std::min(std::abs(dot(p.normal, omega_)) * p.area * smallest_part(patch), median_area_) /
           (grid.unit * grid.unit);
  }
  /// FragmentOutlines::smallest_part of a patch.
  double smallest_part(PatchId patch) const {
    return smallest_part_ == nullptr ? 1 : at(*smallest_part_, patch);
  }

  /// Corner k of a fragment as a corner of its outline. The outline of a back-facing fragment is
  /// reversed: the edge that arrived at a corner leaves it.
  FragmentOutlines::Corner corner_of(const FragmentOutlines& outlines, const Fragment& fragment,
                                     std::uint32_t k) const;
  /// Whether corner k is the rounded point. Others are where the lines of their edges meet; if
  /// these are nearly parallel, that may be far away.
  bool is_grid_point(const FragmentOutlines& outlines, const Fragment& fragment,
                     std::uint32_t k) const;
  struct Position {
    long double x, y;
  };
  /// The position of corner k in grid units from `origin`. For a needle cut by the tree it is where
  /// the lines of the corner's edges meet: the distance of the rounded corner from its lines is a
  /// large part of the needle's width.
  Position position_of(const FragmentOutlines& outlines, const Fragment& fragment, std::uint32_t k,
                       const GridPoint& origin) const;
  /// The line of a corner's edge, in the edge's direction.
  GridLine line_of(const FragmentOutlines& outlines, const FragmentOutlines::Corner& corner) const {
    const BspTree::Line& line = at(outlines.lines, corner.line);
    const GridPoint& a = at(grid.points, line.a);
    const GridPoint& b = at(grid.points, line.b);
    return corner.forward ? GridLine{a, b} : GridLine{b, a};
  }

 private:
  const Scene* scene_ = nullptr;
  /// Corners of fragments that lost corners by rounding, counter-clockwise.
  std::vector<FragmentOutlines::Corner> changed_corners_;
  Vec3 omega_;
  double median_area_ = 0;  ///< median area of the patches, square meters
  const std::vector<double>* smallest_part_ = nullptr;  ///< null: all are 1

  void prefetch(const FragmentOutlines& outlines, const std::vector<FragmentId>& order,
                std::size_t index) const;
  double cut_needle_area(const FragmentOutlines& outlines, const Fragment& fragment) const;
  bool add(const FragmentOutlines& outlines, std::uint32_t outline);
  bool remove_turned_edges(const FragmentOutlines& outlines, Fragment& fragment);
  /// Whether rounding has turned an edge, and then which of its corners remains without it.
  enum class Turned { no, keep_start, keep_end };
  Turned is_turned(const Fragment& fragment, std::uint32_t k) const;
  void remove_edge(const FragmentOutlines& outlines, Fragment& fragment, std::uint32_t k,
                   bool keep_end);
  bool has_outline_outside(const Fragment& fragment, std::uint32_t k) const;
  bool remove_reflex_edges(const FragmentOutlines& outlines, Fragment& fragment);
  void add_or_drop(const FragmentOutlines& outlines, std::uint32_t outline);
  std::size_t add_joined(const FragmentOutlines& outlines, const std::vector<FragmentId>& order,
                         std::size_t index);
  bool turns_one_way(const FragmentOutlines& outlines,
                     const FragmentOutlines::Outline& outline) const;
};

}  // namespace transillum
