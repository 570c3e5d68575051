// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/bsp_tree.h"

namespace transillum {

/// A directed line of the plane. What an edge bounds lies on its left: dx y - dy x + c > 0.
template <class Real>
struct DirectedLine {
  Real dx, dy, c;
  Real length;  ///< |dx| + |dy|
  Real slack;   ///< how far from the line a point of the looking polygon may seem by rounding
  LineId line;
  PointId from, to;  ///< the points of the grid that it was made to run through, in its direction
};
/// Index in a list of lines, doubled, and 1 more where the line is meant the other way round.
using DirectedRef = std::int32_t;

/// On which sides of a line some corners surely lie, one bit a corner.
struct Sides {
  std::uint64_t left = 0, right = 0;
};

/// Finds the sides of corners for one line after the other, and stops at one that surely has none
/// on its left. Determinants within length · (slack + error) of 0 are not sure. Corners come by
/// eights: what lies behind the last may be read, and counts for nothing.
/// @return how many lines were looked at; fewer than `line_count` where it stopped.
template <class Real>
std::size_t find_sides(const Real* x, const Real* y, std::size_t corner_count,
                       const DirectedLine<Real>* lines, const DirectedRef* refs,
                       std::size_t line_count, Real error, Sides* sides);

/// A way to find sides in doubles.
struct FindSidesWay {
  const char* name;
  decltype(find_sides<double>)* find;
};
/// Those that this processor has; find_sides goes by the first.
std::vector<FindSidesWay> find_sides_ways();

}  // namespace transillum
