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
#include "visibility/fast/fast_bins.h"
#include "visibility/fast/projected_fragments.h"

namespace transillum {

/// What one face, or a part of it, sees, where an OutlineView fails or a needle is involved: its
/// polygon is eaten up by the faces it is shown, the nearest first. Coordinates are relative to
/// the face or the bin, where small differences keep their digits.
///
/// Whether a corner lies left of a line is the sign of a determinant: in long double where that is
/// certain, and else in whole numbers from the grid points that corner and line come from.
class ExactView {
 public:
  ExactView(const FastOutlines& outlines, const ProjectedFragments& faces, PassCounts& counts)
      : outlines_(outlines), faces_(faces), counts_(counts) {}

  /// Looks from all of a face.
  void look_from(std::int32_t face);
  /// Looks from the part of a face that lies in a bin, if any.
  void look_from(std::int32_t face, const FastBins::Bin& bin);

  /// Eats up what `face` covers of what is left, and returns its area, steps
  /// squared.
  double subtract(std::int32_t face);
  /// What is left lies in here.
  const FaceWindow& window() const { return window_; }

  /// Never; as OutlineView has it.
  static constexpr bool failed() { return false; }

  /// Whether nothing is left but for rounding.
  bool done() const {
    return left_.empty() || left_area_ <= std::min(0x1p-40L * area_, 64 * reach_);
  }

 private:
  static constexpr std::size_t most_corners = 48;  ///< of a piece
  static constexpr std::size_t many_corners = 24;  ///< a piece of more is cut in half
  static constexpr PointId made_by_cut = FastOutlines::no_point;
  // Lines of a bin's square and of a piece cut in half, in place of LineIds.
  static constexpr LineId low_x = -2, low_y = -3, high_x = -4, high_y = -5, halving = -6;

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
  struct Piece {
    std::size_t count = 0;
    Real error = 0;  ///< of corners made by cuts: along x or y at most
    FaceWindow window;
    std::array<Real, most_corners> x, y;
    std::array<EdgeRef, most_corners> edge;   ///< to the next corner
    std::array<PointId, most_corners> point;  ///< on the grid, or made_by_cut: where its edges meet

    Piece() = default;
    Piece(const Piece& other) { *this = other; }
    Piece& operator=(const Piece& other);
    void add(Real at_x, Real at_y, EdgeRef leaving, PointId on_grid) {
      TRANSILLUM_INVARIANT(count < most_corners, "a piece has room for its corners");
      x[count] = at_x;
      y[count] = at_y;
      edge[count] = leaving;
      point[count++] = on_grid;
    }
  };
  void find_window(Piece& piece) const;
  void start(std::int32_t face, const GridPoint& origin);
  void load_corners(const ProjectedFragments::Face& face, Piece& piece) const;
  void load_edges(const ProjectedFragments::Face& face, Piece& piece);
  EdgeRef add_edge(Real x, Real y, Real dx, Real dy, LineId line, PointId from, PointId to);
  EdgeRef add_edge(const GridLine& through, LineId line, PointId from, PointId to);
  GridLine bin_line(LineId line) const;
  GridLine grid_line(const Edge& edge) const;
  const Edge& edge_of(EdgeRef ref) const { return at(edges_, ref >> 1); }

  Sides sure_sides(const Piece& piece, EdgeRef ref, Real error) const;
  Sides settled(const Piece& piece, EdgeRef ref, Sides sides) const;
  bool find_cuts(const Piece& piece, const Piece& by, Real error, std::uint64_t& cuts);
  Sides measure(const Piece& piece, EdgeRef ref);
  Real exact_side_of(const Piece& piece, std::size_t k, EdgeRef ref) const;
  bool subtract_from_piece(std::uint32_t place, Real& area);
  std::uint32_t new_piece();
  void halve(std::uint32_t place);
  void find_whole_window();
  void split(const Piece& piece, EdgeRef by, Sides sides, Piece& inside, Piece& outside);
  static PointId common_point(const Edge& p, const Edge& q);
  void add_crossing(const Piece& piece, std::size_t from, std::size_t to, EdgeRef by, Piece& inside,
                    Piece& outside);
  static Real area_of(const Piece& piece);

  const FastOutlines& outlines_;
  const ProjectedFragments& faces_;
  PassCounts& counts_;

  GridPoint origin_;
  FastBins::Bin bin_{};
  std::vector<Edge> edges_;  ///< edge_count_ of them, then places to be used again
  std::size_t edge_count_ = 0;
  std::size_t kept_edges_ = 0;        ///< of them, those that pieces refer to
  Real reach_ = 0, shown_reach_ = 0;  ///< largest |x| + |y| of what looks and what is shown
  Real area_ = 0, left_area_ = 0;
  Real most_ = 0;  ///< that may still be seen: a needle's area, which cuts may exceed
  FaceWindow window_;
  std::vector<Piece> pieces_;         ///< places for them
  std::vector<std::uint32_t> left_;   ///< the places of what is left
  std::vector<std::uint32_t> parts_;  ///< … of what subtract_from_piece() has just put beside it
  std::vector<std::uint32_t> unused_;
  Piece shown_;
  std::array<Piece, 2> rest_;
  std::array<Sides, most_corners> sides_of_edges_;
  std::array<Real, most_corners> sides_;  ///< of the corners measure() was given
};

}  // namespace transillum
