// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The implementations of boundary_cut.h, one per SIMD instruction set, and what they share. All
// give the same bits: they round the same products and sums in the same order, without fused
// multiply-add.
#pragma once

#include <bit>
#include <vector>

#include "visibility/queries/boundary_cut.h"

namespace transillum {

/// Segments by how they meet one line of the cutter, one bit per segment.
struct Crossings {
  std::uint64_t out, in;  ///< cross the line outward, inward
  std::uint64_t low;      ///< cross it nearer to the edge's first corner than to its second
  std::uint64_t inner;    ///< have a point on the inner side
};
using LineCrossings = std::array<Crossings, Cutter::max_edges>;

/// Sum of eight lanes, in the order that all backends use.
inline double sum_of_eight(const std::array<double, 8>& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// Clears what is recorded per line.
inline void reset(LineCrossings& lines, BoundaryCut& cut, std::size_t count) {
  cut.inside = 0;
  for (std::size_t m = 0; m < count; ++m) {
    lines[m] = {};
    cut.enters[m] = cut.leaves[m] = 0;
  }
}

/// Whether the whole region is on the outer side of one of the first `count` lines.
inline bool is_outside(const LineCrossings& lines, std::size_t count) {
  for (std::size_t m = 0; m < count; ++m) {
    if (lines[m].inner == 0) {
      return true;
    }
  }
  return false;
}

/// Computes the winding numbers at the cutter's corners. Along a line of the cutter, the region is
/// entered and left where its boundary crosses the line. Crossings that are not end points of an
/// inside part lie beyond the edge's corners: those before the first corner give its winding
/// number.
inline void find_windings(const LineCrossings& lines, std::size_t count, BoundaryCut& cut) {
  for (std::size_t m = 0; m < count; ++m) {
    cut.winding[m] = std::popcount(lines[m].out & ~cut.leaves[m] & lines[m].low) -
                     std::popcount(lines[m].in & ~cut.enters[m] & lines[m].low);
  }
}

/// Recomputes the lines through points farther than `far` in long double.
void recompute_far_lines(Cutter& cutter, const GridPoint* corners, const GridPoint& origin,
                         double far);

/// The functions of boundary_cut.h for one instruction set.
struct SimdBackend {
  const char* name;
  decltype(set_cutter)* set;
  decltype(cut_boundary)* cut;
  decltype(extent_of)* extent;
};

SimdBackend scalar_backend();
#if defined(__x86_64__)
SimdBackend avx2_backend();    ///< four doubles at a time
SimdBackend avx512_backend();  ///< eight doubles at a time; requires AVX-512 F and DQ
#endif
/// The backends that this processor supports, widest first; boundary_cut.h uses the first.
std::vector<SimdBackend> simd_backends();

}  // namespace transillum
