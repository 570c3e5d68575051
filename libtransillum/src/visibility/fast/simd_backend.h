// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The implementations of outline cutting, one for each SIMD instruction set, and what they share.
// All give the same bits: they round the same products and sums, in the same order, and nothing is
// fused.
#pragma once

#include <bit>
#include <vector>

#include "visibility/fast/outline_cut.h"

namespace transillum {

/// The segments that cross a cutter's line, from its inner side out or from outside in; a bit each.
struct Crossings {
  std::uint64_t out, in;
  std::uint64_t low;    ///< nearer to the edge's first corner than to its second
  std::uint64_t inner;  ///< segments with something on the inner side
};
using LineCrossings = std::array<Crossings, Cutter::most>;

/// Sums in the order that all backends keep.
inline double sum_of_eight(const std::array<double, 8>& v) {
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}

/// Along a line of the cutter the region is entered and left where its outline crosses. Crossings
/// that are no ends of a part inside lie beyond the edge's corners: those before the first
/// corner tell whether it is in the region.
inline void find_windings(const LineCrossings& lines, std::size_t count, OutlineCut& cut) {
  for (std::size_t m = 0; m < count; ++m) {
    cut.winding[m] = std::popcount(lines[m].out & ~cut.goes_out[m] & lines[m].low) -
                     std::popcount(lines[m].in & ~cut.comes_in[m] & lines[m].low);
  }
}

/// The lines through points farther than `far` anew, in long double.
void settle_far_lines(Cutter& cutter, const GridPoint* corners, const GridPoint& origin,
                      double far);

/// The functions of outline_cut.h for one instruction set.
struct SimdBackend {
  const char* name;
  decltype(set_cutter)* set;
  decltype(cut_outline)* cut;
  decltype(extent_of)* extent;
};

SimdBackend scalar_backend();
#if defined(__x86_64__)
SimdBackend avx2_backend();    ///< four doubles at a time
SimdBackend avx512_backend();  ///< eight doubles at a time; requires AVX-512 F and DQ
#endif
/// The backends that this processor supports, widest first; outline_cut.h uses the first.
std::vector<SimdBackend> simd_backends();

}  // namespace transillum
