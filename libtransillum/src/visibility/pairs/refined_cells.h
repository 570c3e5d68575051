// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "geometry/form_factor.h"

namespace transillum {

/// Two sums over points of a cell: of what they see of the other polygon past blockers, and of what
/// they would see without them, m².
struct PointSums {
  double seen = 0, free = 0;
  std::array<double, 2> moments{};  ///< `seen` with phi_1 and phi_2 of a receiver as factors, m²
};

/// The exchange past blockers of cells near which the other polygon is so close that points, evenly
/// spread, miss where the light is.
///
/// Without blockers the exchange of a cell is known exactly. Where the points do not give that, the
/// cell is divided, and what is left of the difference is taken to be blocked as the rest.
class RefinedCells {
 public:
  using ByPoints = std::function<PointSums(Outline cell, int divisions)>;

  /// @param facing of which one is sampled
  RefinedCells(const FacingPolygons& facing, bool p_is_sampled, ByPoints by_points);
  /// @param whole polygon_exchange() of `facing`
  RefinedCells(const FacingPolygons& facing, bool p_is_sampled, ByPoints by_points, double whole);

  /// The exchange of a cell without blockers, m².
  double exact(Outline cell);
  /// Whether points whose sum is `free` miss the exchange `exact` of a cell.
  bool misses(double free, double exact) const;
  /// The exchange of a cell, and an estimate of its error, m².
  struct Exchange {
    double area = 0, error = 0;
    std::array<double, 2> moments{}, moment_errors{};  ///< PointSums::moments
  };
  Exchange operator()(Outline cell);

 private:
  void add(Outline triangle, int most_divisions, Exchange& sum);

  FacingPolygons facing_;
  bool p_is_sampled_;
  double whole_;  ///< exchange of all cells without blockers, m²
  ByPoints by_points_;
};

/// Cuts `sampled` along the lines where blockers cross it or stand on it: what it sees differs from
/// one side of them to the other. Then along the lines from which an edge of `other` and a parallel
/// edge of a blocker are in line. There, the form factor to the visible part of `large` has a kink
/// as a function of the point; where other edges and corners are in line, only its second
/// derivative jumps.
/// @param sampled convex; the cells are convex and make it up.
/// @param tolerance lines that reach no deeper into a cell do not cut it, m.
/// @returns a few dozen cells at most: further lines, and lines of many blockers, cut nothing.
std::vector<Corners> smooth_cells(Outline sampled, Outline other,
                                  const std::vector<Corners>& blockers, double tolerance);

}  // namespace transillum
