// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The visibility query with exact signs, for the few fragments where doubles do not suffice. Input:
// the projected fragments of a direction; FastPass selects the fragment and its candidates.
//
// The projection of the querying fragment, or of its part in one bin, is kept as a set of disjoint
// convex polygons. Each candidate removes from each polygon what it covers: the polygon is split
// along the candidate's edges into one part inside, whose area is counted, and parts outside, which
// remain. Whether a corner lies left of a line is the sign of a determinant: computed in long
// double where that is certain, otherwise in integers from the grid points that define corner and
// line.
//
// clang-format off
// States. All polygons are stored in the pool polygons_; each index into it is in exactly one of
//   remaining_  not covered by any candidate so far,
//   new_parts_  split off by the candidate being subtracted; empty between calls of subtract(),
//   free_       unused, to be reused by new_polygon().
//
//   begin_query()   remaining_ = { the fragment, clipped to the bin }; all others free
//   subtract()      for each polygon in remaining_ whose window overlaps the candidate's box,
//                   subtract_from_polygon() finds it
//                     disjoint:  the polygon stays in remaining_
//                     covered:   the polygon -> free_
//                     cut:       the polygon -> free_, its parts outside -> new_parts_
//                   then new_parts_ -> remaining_
//   done()          remaining_ is empty, or its area is rounding only
// clang-format on
//
// edges_ holds the lines of all edges: [0, kept_edges_) for the polygons above, and
// [kept_edges_, edge_count_) for the current candidate. They are discarded when the next
// candidate is loaded, unless the candidate has cut a polygon: its parts refer to them.
//
// Notation: an index is a position in polygons_; a ref is an EdgeRef; k is a corner, and edge k
// runs from corner k to corner k + 1. Coordinates are in grid units relative to origin_, a corner
// of the fragment or the center of the bin, so that small differences keep their digits.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/invariant.h"
#include "transillum/at.h"
#include "transillum/transfers.h"
#include "visibility/queries/exact_side.h"
#include "visibility/queries/fragment_bins.h"
#include "visibility/queries/needle_frame.h"
#include "visibility/queries/projected_fragments.h"

namespace transillum {

/// The visibility query of one projected fragment, or of its part in one bin, with exact signs.
/// Same use as BoundaryView; used where that fails. One query at a time.
class ExactView {
 public:
  using Coordinate = long double;

  /// @param keep_covered whether for_each_covered_segment() will be called
  ExactView(const FragmentOutlines& outlines, const ProjectedFragments& projected,
            PassCounts& counts, bool keep_covered)
      : outlines_(outlines), projected_(projected), counts_(counts), keep_covered_(keep_covered) {}

  /// Begins the query of a whole fragment.
  void begin_query(std::int32_t fragment);
  /// Begins the query of the part of a fragment that lies in a bin, which may be empty.
  void begin_query(std::int32_t fragment, const FragmentBins::Bin& bin);

  /// Subtracts a candidate from what remains, and returns the area that it covered, in square grid
  /// units.
  double subtract(std::int32_t candidate);
  /// Bounds of what remains.
  const FragmentWindow& window() const { return window_; }

  /// The point that coordinates are relative to.
  const GridPoint& origin() const { return origin_; }
  /// Calls visit(px, py, qx, qy) for each directed segment that bounds what the last subtract()
  /// covered, convex polygon by convex polygon.
  template <class Visit>
  void for_each_covered_segment(Visit visit) const {
    for (const Polygon& part : covered_parts_) {
      for (std::size_t k = 0; k < part.count; ++k) {
        const std::size_t next = k + 1 < part.count ? k + 1 : 0;
        visit(part.x[k], part.y[k], part.x[next], part.y[next]);
      }
    }
  }

  /// The same in the coordinates of frame().
  template <class Visit>
  void for_each_framed_segment(Visit visit) const {
    const NeedleFrame map = frame();
    const auto dx = static_cast<Real>(origin_.x - map.origin.x);
    const auto dy = static_cast<Real>(origin_.y - map.origin.y);
    for_each_covered_segment([&](Real px, Real py, Real qx, Real qy) {
      const NeedleFrame::Point p = map.map(px + dx, py + dy), q = map.map(qx + dx, qy + dy);
      visit(p.x, p.y, q.x, q.y);
    });
  }
  /// Coordinates in which the fragment is about as high as long.
  NeedleFrame frame() const {
    const ProjectedFragments::Fragment& own = at(projected_.fragments, fragment_);
    const std::span<const GridPoint> corners(projected_.corners);
    return NeedleFrame::around(corners.subspan(own.begin, own.end - own.begin));
  }

  // Never; for the same use as BoundaryView.
  static constexpr bool failed() { return false; }
  static constexpr bool is_too_small() { return false; }
  static constexpr bool is_crowded() { return false; }
  static constexpr bool divide() { return false; }
  static constexpr std::size_t waiting_parts() { return 0; }
  static constexpr void next_part() {}

  /// Whether nothing remains but rounding.
  bool done() const {
    return remaining_.empty() || remaining_area_ <= std::min(0x1p-40L * area_, 64 * reach_);
  }

 private:
  static constexpr std::size_t max_corners = 48;      ///< most corners of a polygon
  static constexpr std::size_t halving_corners = 24;  ///< a polygon with more is split in half
  static constexpr PointId made_by_cut = FragmentOutlines::no_point;
  // In place of LineIds: the sides of a bin's square, and the chord of a polygon split in half.
  static constexpr LineId low_x = -2, low_y = -3, high_x = -4, high_y = -5, halving_line = -6;

  using Real = long double;
  struct LineName {
    LineId id;
    PointId from, to;  ///< grid points that define the line, in its direction, or made_by_cut
  };
  /// A directed line. The polygon of an edge lies on its left: dx y - dy x + c > 0.
  struct Edge {
    Real dx, dy, c;
    Real length;  ///< |dx| + |dy|
    Real slack;   ///< bound on the apparent distance from the line, by rounding, of a point on it
    LineId line;
    PointId from, to;  ///< LineName::from and to
  };
  /// Twice an index in edges_, plus 1 if the edge runs against its line.
  using EdgeRef = std::int32_t;
  /// The corners of a polygon that lie left and right of a line, one bit per corner.
  struct Sides {
    std::uint64_t left = 0, right = 0;
  };

  /// A convex polygon, counter-clockwise.
  struct Polygon {
    std::size_t count = 0;
    Real error = 0;  ///< bound on the error of x and y of corners made by cuts
    FragmentWindow window;
    std::array<Real, max_corners> x, y;
    std::array<EdgeRef, max_corners> edge;   ///< to the next corner
    std::array<PointId, max_corners> point;  ///< grid point, or made_by_cut: where its edges meet

    Polygon() = default;
    Polygon(const Polygon& other) { *this = other; }
    Polygon& operator=(const Polygon& other);
    void add(Real at_x, Real at_y, EdgeRef leaving, PointId on_grid) {
      TRANSILLUM_INVARIANT(count < max_corners, "a polygon has room for its corners");
      x[count] = at_x;
      y[count] = at_y;
      edge[count] = leaving;
      point[count++] = on_grid;
    }
    /// Adds corner k of another polygon, with another edge leaving it.
    void add_corner(const Polygon& other, std::size_t k, EdgeRef leaving) {
      add(other.x[k], other.y[k], leaving, other.point[k]);
    }
  };
  // Loading fragments.
  void start_query(std::int32_t fragment, const GridPoint& origin);
  void load_corners(const ProjectedFragments::Fragment& fragment, Polygon& polygon) const;
  void load_edges(const ProjectedFragments::Fragment& fragment, Polygon& polygon);
  EdgeRef add_edge(Real x, Real y, Real dx, Real dy, LineName line);
  EdgeRef add_edge(const GridLine& through, LineName line);
  GridLine bin_line(LineId line) const;
  GridLine grid_line(const Edge& edge) const;
  const Edge& edge_of(EdgeRef ref) const { return at(edges_, ref >> 1); }

  // Sides of lines.
  Sides certain_sides(const Polygon& polygon, EdgeRef ref, Real error) const;
  Sides settle_uncertain(const Polygon& polygon, EdgeRef ref, Sides sides) const;
  bool find_cuts(const Polygon& polygon, const Polygon& by, Real error, std::uint64_t& cuts);
  Sides measure_sides(const Polygon& polygon, EdgeRef ref);
  Real exact_side_of(const Polygon& polygon, std::size_t k, EdgeRef ref) const;

  // Subtracting and splitting.
  bool subtract_from_polygon(std::uint32_t index, Real& area);
  bool add_covered(const Polygon& part, Real& area);
  std::uint32_t new_polygon();
  void split_in_half(std::uint32_t index);
  void split(const Polygon& polygon, EdgeRef by, Polygon& inside, Polygon& outside);
  static PointId common_point(const Edge& p, const Edge& q);
  void add_crossing(const Polygon& polygon, std::size_t from, std::size_t to, EdgeRef by,
                    Polygon& inside, Polygon& outside);
  void find_window(Polygon& polygon) const;
  void update_window();
  static Real area_of(const Polygon& polygon);

  const FragmentOutlines& outlines_;
  const ProjectedFragments& projected_;
  PassCounts& counts_;

  GridPoint origin_;
  std::int32_t fragment_ = 0;  ///< the querying fragment
  FragmentBins::Bin bin_{};    ///< bin of the query; only if the polygons have edges on its sides
  std::vector<Edge> edges_;    ///< the first edge_count_ are in use
  std::size_t edge_count_ = 0;
  std::size_t kept_edges_ = 0;  ///< the first ones, to which polygons of the pool refer
  Real reach_ = 0;              ///< largest |x| + |y| of the querying fragment
  Real candidate_reach_ = 0;    ///< the same of the candidate
  Real candidate_perimeter_ = 0, candidate_area_ = 0;  ///< measures of the projected outline
  Real area_ = 0;  ///< area of the querying fragment, or of its part in the bin
  Real remaining_area_ = 0;
  Real max_area_ = 0;      ///< bound on the area still to be found: a needle's area, which cuts may
                           ///< exceed; infinite otherwise
  FragmentWindow window_;  ///< window of all remaining polygons
  std::vector<Polygon> polygons_;  ///< the pool; see the states above
  std::vector<std::uint32_t> remaining_, new_parts_, free_;
  std::vector<Polygon> covered_parts_;  ///< by the last subtract(); if keep_covered_
  const bool keep_covered_;
  Polygon candidate_;
  // Used by subtract_from_polygon() only.
  std::array<Polygon, 2> inside_;  ///< in turn: what is inside all edges so far
  std::array<Sides, max_corners> sides_of_edges_;
  std::array<Real, max_corners> sides_;  ///< determinants of the corners given to measure_sides()
};

}  // namespace transillum
