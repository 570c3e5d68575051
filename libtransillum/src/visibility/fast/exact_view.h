// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/invariant.h"
#include "transillum/at.h"
#include "transillum/transfers.h"
#include "visibility/fast/exact_side.h"
#include "visibility/fast/fragment_bins.h"
#include "visibility/fast/projected_fragments.h"

namespace transillum {

/// What one fragment, or a part of it, sees, where an BoundaryView fails or a needle is involved:
/// its polygon is eaten up by the fragments it is candidate, the nearest first. Coordinates are
/// relative to the fragment or the bin, where small differences keep their digits.
///
/// Whether a corner lies left of a line is the sign of a determinant: in long double where that is
/// certain, and else in whole numbers from the grid points that corner and line come from.
class ExactView {
 public:
  ExactView(const FragmentOutlines& outlines, const ProjectedFragments& projected,
            PassCounts& counts)
      : outlines_(outlines), projected_(projected), counts_(counts) {}

  /// Looks from all of a fragment.
  void begin_query(std::int32_t fragment);
  /// Looks from the part of a fragment that lies in a bin, if any.
  void begin_query(std::int32_t fragment, const FragmentBins::Bin& bin);

  /// Eats up what `fragment` covers of what is left, and returns its area, steps
  /// squared.
  double subtract(std::int32_t fragment);
  /// What is left lies in here.
  const FragmentWindow& window() const { return window_; }

  /// Never; as BoundaryView has it.
  static constexpr bool failed() { return false; }

  /// Whether nothing is left but for rounding.
  bool done() const {
    return remaining_.empty() || remaining_area_ <= std::min(0x1p-40L * area_, 64 * reach_);
  }

 private:
  static constexpr std::size_t max_corners = 48;      ///< of a polygon
  static constexpr std::size_t halving_corners = 24;  ///< a polygon of more is cut in half
  static constexpr PointId made_by_cut = FragmentOutlines::no_point;
  // Lines of a bin's square and of a polygon cut in half, in place of LineIds.
  static constexpr LineId low_x = -2, low_y = -3, high_x = -4, high_y = -5, halving_line = -6;

  using Real = long double;
  /// A directed line of the plane. What an edge bounds lies on its left: dx y - dy x + c > 0.
  struct Edge {
    Real dx, dy, c;
    Real length;  ///< |dx| + |dy|
    Real slack;   ///< how far from the line a point of the looking polygon may seem by rounding
    LineId line;
    PointId from, to;  ///< points of the grid that it was made to run through, in its direction
  };
  /// Index in edges_, doubled, and 1 more where the edge is meant the other way round.
  using EdgeRef = std::int32_t;
  /// On which sides of a line some corners lie, one bit a corner.
  struct Sides {
    std::uint64_t left = 0, right = 0;
  };

  /// A convex polygon, counter-clockwise.
  struct Polygon {
    std::size_t count = 0;
    Real error = 0;  ///< of corners made by cuts: along x or y at most
    FragmentWindow window;
    std::array<Real, max_corners> x, y;
    std::array<EdgeRef, max_corners> edge;   ///< to the next corner
    std::array<PointId, max_corners> point;  ///< on the grid, or made_by_cut: where its edges meet

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
  };
  void find_window(Polygon& polygon) const;
  void start_query(std::int32_t fragment, const GridPoint& origin);
  void load_corners(const ProjectedFragments::Fragment& fragment, Polygon& polygon) const;
  void load_edges(const ProjectedFragments::Fragment& fragment, Polygon& polygon);
  EdgeRef add_edge(Real x, Real y, Real dx, Real dy, LineId line, PointId from, PointId to);
  EdgeRef add_edge(const GridLine& through, LineId line, PointId from, PointId to);
  GridLine bin_line(LineId line) const;
  GridLine grid_line(const Edge& edge) const;
  const Edge& edge_of(EdgeRef ref) const { return at(edges_, ref >> 1); }

  Sides certain_sides(const Polygon& polygon, EdgeRef ref, Real error) const;
  Sides settle_uncertain(const Polygon& polygon, EdgeRef ref, Sides sides) const;
  bool find_cuts(const Polygon& polygon, const Polygon& by, Real error, std::uint64_t& cuts);
  Sides measure_sides(const Polygon& polygon, EdgeRef ref);
  Real exact_side_of(const Polygon& polygon, std::size_t k, EdgeRef ref) const;
  bool subtract_from_polygon(std::uint32_t place, Real& area);
  std::uint32_t new_polygon();
  void split_in_half(std::uint32_t place);
  void update_window();
  void split(const Polygon& polygon, EdgeRef by, Sides sides, Polygon& inside, Polygon& outside);
  static PointId common_point(const Edge& p, const Edge& q);
  void add_crossing(const Polygon& polygon, std::size_t from, std::size_t to, EdgeRef by,
                    Polygon& inside, Polygon& outside);
  static Real area_of(const Polygon& polygon);

  const FragmentOutlines& outlines_;
  const ProjectedFragments& projected_;
  PassCounts& counts_;

  GridPoint origin_;
  FragmentBins::Bin bin_{};
  std::vector<Edge> edges_;  ///< edge_count_ of them, then places to be used again
  std::size_t edge_count_ = 0;
  std::size_t kept_edges_ = 0;  ///< of them, those that pieces refer to
  Real reach_ = 0,
       candidate_reach_ = 0;  ///< largest |x| + |y| of what queries and what is candidate
  Real area_ = 0, remaining_area_ = 0;
  Real max_area_ = 0;  ///< that may still be seen: a needle's area, which cuts may exceed
  FragmentWindow window_;
  std::vector<Polygon> polygons_;         ///< places for them
  std::vector<std::uint32_t> remaining_;  ///< the places of what is left
  std::vector<std::uint32_t>
      new_parts_;  ///< … of what subtract_from_polygon() has just put beside it
  std::vector<std::uint32_t> free_;
  Polygon candidate_;
  std::array<Polygon, 2> rest_;
  std::array<Sides, max_corners> sides_of_edges_;
  std::array<Real, max_corners> sides_;  ///< of the corners measure_sides() was given
};

}  // namespace transillum
