// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

#include "geometry/form_factor.h"

namespace transillum {

/// Two sums over points of a cell: of what they see of the other polygon past blockers, and of what
/// they would see without them, m².
struct PointSums {
  double seen = 0, free = 0;
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

  /// Whether points whose sum is `free` miss the exchange of a cell.
  bool misses(Outline cell, double free);
  /// The exchange of a cell, and an estimate of its error, m².
  struct Exchange {
    double area = 0, error = 0;
  };
  Exchange operator()(Outline cell);

 private:
  double exact(Outline cell);
  void add(Outline triangle, int most_divisions, Exchange& sum);

  FacingPolygons facing_;
  bool p_is_sampled_;
  double whole_;  ///< exchange of all cells without blockers, m²
  ByPoints by_points_;
};

}  // namespace transillum
