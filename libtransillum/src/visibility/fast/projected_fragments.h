// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
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
#include "visibility/fast/exact_side.h"
#include "visibility/fast/grid_projection.h"
#include "visibility/fast/patch_shaft.h"

namespace transillum {

/// The fragments of a tree as the fast engine takes them: with no more than most_corners corners,
/// cut along diagonals where they have more. Made once a tree.
struct FastOutlines {
  static constexpr std::size_t most_corners = 16;
  static constexpr PointId no_point = -1;
  struct Outline {
    PatchId patch;
    std::uint32_t begin, end;  ///< in `corners`
    bool plain;                ///< each edge's line runs through its own two corners
  };
  struct Corner {
    PointId point;
    LineId line;   ///< of the edge to the next corner
    bool forward;  ///< that edge runs along its line from a to b
    bool exact;    ///< both its edges' lines were made to run through it
  };
  std::vector<BspTree::Line> lines;  ///< the tree's, then diagonals
  std::vector<Corner> corners;
  std::vector<Outline> outlines;
  std::vector<std::uint32_t> first;  ///< outline of a fragment; one more at the end

  explicit FastOutlines(const BspTree& tree);

 private:
  void add(PatchId patch, const std::vector<BspTree::Corner>& part);
};

/// How far something reaches along x, y, x + y and x - y, in steps of the grid, rounded outward:
/// four lower ends, then the four upper ends negated.
struct alignas(16) FaceBox {
  std::array<float, 8> ends;
};
/// The same, upper ends first and the lower ends negated: what a FaceBox is compared with.
struct alignas(16) FaceWindow {
  std::array<float, 8> ends;

  void add(const FaceWindow& other) {
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
  bool overlaps(const FaceBox& box) const {
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
/// A float that is no larger than a number of steps.
inline float rounded_down(double steps) {
  return static_cast<float>(steps - 0x1p-23 * std::abs(steps) - 1);
}

inline float rounded_up(double steps) {
  return static_cast<float>(steps + 0x1p-23 * std::abs(steps) + 1);
}

/// All fragments of a tree seen along one direction, farthest toward it first; those seen edge-on
/// are left out.
struct ProjectedFragments {
  struct Face {
    std::uint32_t begin, end;  ///< in `corners`
    std::uint32_t outline;     ///< whose corners they are, the other way round where not front
    PatchId patch;
    bool front;       ///< it receives for omega
    bool cut_needle;  ///< thin, and cut by the tree: see place_of()
    double area;      ///< of the projection, in steps squared; > 0
  };
  GridProjection grid;
  std::vector<FaceBox> boxes;
  std::vector<Face> faces;
  std::vector<GridPoint> corners;  ///< counter-clockwise; made by a cut of the tree: a step off

  /// Fills all of this anew; with only those fragments of the tree that `shaft` may hold, if given.
  /// @throws Canceled
  void project(const Scene& scene, const BspTree& tree, const FastOutlines& outlines,
               const Vec3& omega, const Cancellation& cancellation,
               const PatchShaft* shaft = nullptr);

  /// What corner k of a face is made of. Of one seen from behind the outline is turned round: the
  /// edge that arrived at a corner leaves it.
  static FastOutlines::Corner corner_of(const FastOutlines& outlines, const Face& face,
                                        std::uint32_t k);
  /// Where it lies, steps from `origin`: of a needle that the tree has cut it is where its edges'
  /// lines meet, for the step by which its place on the grid is off them is much of the needle's
  /// width.
  struct Place {
    long double x, y;
  };
  Place place_of(const FastOutlines& outlines, const Face& face, std::uint32_t k,
                 const GridPoint& origin) const;
  /// The line of a corner's edge, in its direction.
  GridLine line_of(const FastOutlines& outlines, const FastOutlines::Corner& corner) const {
    const BspTree::Line& line = at(outlines.lines, corner.line);
    const GridPoint& a = at(grid.points, line.a);
    const GridPoint& b = at(grid.points, line.b);
    return corner.forward ? GridLine{a, b} : GridLine{b, a};
  }

 private:
  void fetch(const FastOutlines& outlines, const std::vector<FragmentId>& order,
             std::size_t place) const;
  double cut_needle_area(const FastOutlines& outlines, const Face& face) const;
  bool add(const FastOutlines& outlines, std::uint32_t outline);
};

}  // namespace transillum
