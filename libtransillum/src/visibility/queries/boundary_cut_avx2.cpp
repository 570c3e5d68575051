// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of engine fast with AVX2, four segments at once, for processors without AVX-512:
// the same steps as boundary_cut_scalar.cpp, lane by lane.
//
// Notation: g is the number of the first of the four segments, m a line of the cutter.
#if defined(__x86_64__)
#include <immintrin.h>

#include <bit>
#include <cmath>

#include "visibility/queries/simd_backend.h"

#define TRANSILLUM_AVX2 __attribute__((target("avx2,popcnt")))
#define TRANSILLUM_AVX2_INLINE TRANSILLUM_AVX2 __attribute__((always_inline)) inline

namespace transillum {
namespace {

/// Lanes as bits, and the same lanes all ones.
TRANSILLUM_AVX2 inline unsigned bits_of(__m256d lanes) {
  return static_cast<unsigned>(_mm256_movemask_pd(lanes));
}
TRANSILLUM_AVX2 inline __m256d lanes_of(unsigned bits) {
  const __m256i lane = _mm256_set_epi64x(8, 4, 2, 1);
  const __m256i chosen = _mm256_and_si256(_mm256_set1_epi64x(bits), lane);
  return _mm256_castsi256_pd(_mm256_cmpeq_epi64(chosen, lane));
}

unsigned filled(std::size_t count, std::size_t from) {
  return count - from >= 4 ? 0xfU : (1U << (count - from)) - 1U;
}

TRANSILLUM_AVX2 inline __m256d dot(__m256d ax, __m256d ay, __m256d bx, __m256d by) {
  return _mm256_add_pd(_mm256_mul_pd(ax, bx), _mm256_mul_pd(ay, by));
}
TRANSILLUM_AVX2 inline __m256d cross(__m256d ax, __m256d ay, __m256d bx, __m256d by) {
  return _mm256_sub_pd(_mm256_mul_pd(ax, by), _mm256_mul_pd(ay, bx));
}

/// For each set of lanes, the indices of their 32-bit halves, in order: packs them to the front.
constexpr std::array<std::array<int, 8>, 16> packed_halves = [] {
  std::array<std::array<int, 8>, 16> halves{};
  for (std::size_t bits = 0; bits < 16; ++bits) {
    std::size_t next = 0;
    for (int lane = 0; lane < 4; ++lane) {
      if ((bits >> lane & 1) == 0) {
        continue;
      }
      halves[bits][next++] = 2 * lane;
      halves[bits][next++] = 2 * lane + 1;
    }
  }
  return halves;
}();

TRANSILLUM_AVX2 inline __m256d packed(__m256d v, __m256i halves) {
  return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(v), halves));
}

/// Appends the segments from a to b of the lanes in `chosen`.
TRANSILLUM_AVX2 inline void append(BoundarySegments& to, unsigned chosen, __m256d ax, __m256d ay,
                                   __m256d bx, __m256d by) {
  const std::size_t k = to.count;
  const __m256i halves =
      _mm256_loadu_si256(reinterpret_cast<const __m256i*>(packed_halves[chosen].data()));
  _mm256_storeu_pd(&to.ax[k], packed(ax, halves));
  _mm256_storeu_pd(&to.ay[k], packed(ay, halves));
  _mm256_storeu_pd(&to.bx[k], packed(bx, halves));
  _mm256_storeu_pd(&to.by[k], packed(by, halves));
  to.count += static_cast<std::size_t>(std::popcount(chosen));
}

/// Which of four segments have a part inside the cutter, and where that starts or ends on one of
/// its lines; one bit per segment.
struct InsideParts {
  unsigned inside = 0, starts = 0, ends = 0;
};

/// Four segments, clipped by the lines of the cutter one after another. The part of a segment
/// inside the lines so far runs from a + first u to a + last u.
struct Four {
  unsigned all = 0;     ///< lanes in use, one bit each
  unsigned inside = 0;  ///< lanes with a part inside
  unsigned starts = 0;  ///< lanes whose inside part starts on a line
  unsigned ends = 0;    ///< lanes whose inside part ends on a line
  __m256d all_lanes;    ///< `all`, as lanes
  __m256d ax, ay, bx, by;
  __m256d ux, uy;  ///< b - a
  __m256d first, last;
  /// Per line of the cutter: lanes whose `first` or `last` the line has changed.
  std::array<unsigned, Cutter::max_edges> first_by, last_by;
};

/// Loads the segments from number g on.
TRANSILLUM_AVX2_INLINE void load_four(const BoundarySegments& region, std::size_t g, Four& four) {
  four.all = four.inside = filled(region.count, g);
  four.all_lanes = lanes_of(four.all);
  four.ax = _mm256_load_pd(&region.ax[g]);
  four.ay = _mm256_load_pd(&region.ay[g]);
  four.bx = _mm256_load_pd(&region.bx[g]);
  four.by = _mm256_load_pd(&region.by[g]);
  four.ux = _mm256_sub_pd(four.bx, four.ax);
  four.uy = _mm256_sub_pd(four.by, four.ay);
  four.first = _mm256_setzero_pd();
  four.last = _mm256_set1_pd(1);
}

/// Clips the segments, those from number g on, by line m. Returns false if none of them has a point
/// on its inner side.
TRANSILLUM_AVX2_INLINE bool clip_by_line(const Cutter& cutter, std::size_t m, std::size_t g,
                                         Four& four, Crossings& crossings) {
  const __m256d zero = _mm256_setzero_pd(), one = _mm256_set1_pd(1);
  const __m256d dx = _mm256_broadcast_sd(&cutter.dx[m]), dy = _mm256_broadcast_sd(&cutter.dy[m]);
  const __m256d c = _mm256_broadcast_sd(&cutter.c[m]);
  const __m256d high = _mm256_set1_pd(cutter.tolerance * cutter.length[m]),
                low = _mm256_sub_pd(zero, high);
  const __m256d a = _mm256_add_pd(cross(dx, dy, four.ax, four.ay), c);
  const __m256d b = _mm256_add_pd(cross(dx, dy, four.bx, four.by), c);
  const __m256d a_in = _mm256_and_pd(four.all_lanes, _mm256_cmp_pd(a, low, _CMP_GE_OQ));
  const __m256d b_in = _mm256_and_pd(four.all_lanes, _mm256_cmp_pd(b, low, _CMP_GE_OQ));
  const unsigned a_bits = bits_of(a_in), b_bits = bits_of(b_in);
  four.inside &= a_bits | b_bits;
  crossings.inner |= a_bits | b_bits;
  four.first_by[m] = four.last_by[m] = 0;
  if (a_bits == b_bits) {
    return a_bits != 0;
  }
  const __m256d out = _mm256_andnot_pd(b_in, a_in), in = _mm256_andnot_pd(a_in, b_in);
  __m256d t = _mm256_div_pd(a, _mm256_sub_pd(a, b));
  t = _mm256_blendv_pd(t, zero, _mm256_and_pd(out, _mm256_cmp_pd(a, high, _CMP_LE_OQ)));
  t = _mm256_blendv_pd(t, one, _mm256_and_pd(in, _mm256_cmp_pd(b, high, _CMP_LE_OQ)));
  const __m256d later = _mm256_and_pd(in, _mm256_cmp_pd(t, four.first, _CMP_GT_OQ));
  const __m256d sooner = _mm256_and_pd(out, _mm256_cmp_pd(t, four.last, _CMP_LT_OQ));
  four.first = _mm256_blendv_pd(four.first, t, later);
  four.last = _mm256_blendv_pd(four.last, t, sooner);
  four.first_by[m] = bits_of(later);
  four.last_by[m] = bits_of(sooner);
  const __m256d along =
      _mm256_add_pd(dot(dx, dy, four.ax, four.ay), _mm256_mul_pd(t, dot(dx, dy, four.ux, four.uy)));
  const unsigned nearer =
      bits_of(_mm256_cmp_pd(along, _mm256_broadcast_sd(&cutter.middle[m]), _CMP_LT_OQ));
  crossings.out |= std::uint64_t{a_bits & ~b_bits} << g;
  crossings.in |= std::uint64_t{b_bits & ~a_bits} << g;
  crossings.low |= std::uint64_t{nearer} << g;
  return true;
}

/// Finds the lines on which the inside parts start and end, after clipping by all lines: of those
/// that changed `first` or `last`, the last one.
TRANSILLUM_AVX2_INLINE void find_ends(std::size_t line_count, std::size_t g, Four& four,
                                      BoundaryCut& cut) {
  unsigned no_first = four.inside, no_last = four.inside;
  for (std::size_t m = line_count; m-- > 0;) {
    cut.enters[m] |= std::uint64_t{four.first_by[m] & no_first} << g;
    cut.leaves[m] |= std::uint64_t{four.last_by[m] & no_last} << g;
    no_first &= ~four.first_by[m];
    no_last &= ~four.last_by[m];
  }
  four.starts = four.inside & ~no_first;
  four.ends = four.inside & ~no_last;
}

/// Stores the inside parts in `cut`, and adds their contributions to `twice_area`.
TRANSILLUM_AVX2_INLINE void store_inside(const Four& four, std::size_t g, const Cutter& cutter,
                                         BoundaryCut& cut, __m256d& twice_area) {
  const __m256d one = _mm256_set1_pd(1);
  const __m256d ax = four.ax, ay = four.ay, bx = four.bx, by = four.by;
  const __m256d ux = four.ux, uy = four.uy, first = four.first, last = four.last;
  const __m256d at_b = _mm256_cmp_pd(first, one, _CMP_NLT_UQ);
  const __m256d out_at_b = _mm256_cmp_pd(last, one, _CMP_NLT_UQ);
  const __m256d in_x = _mm256_blendv_pd(_mm256_add_pd(ax, _mm256_mul_pd(first, ux)), bx, at_b);
  const __m256d in_y = _mm256_blendv_pd(_mm256_add_pd(ay, _mm256_mul_pd(first, uy)), by, at_b);
  const __m256d out_x = _mm256_blendv_pd(_mm256_add_pd(ax, _mm256_mul_pd(last, ux)), bx, out_at_b);
  const __m256d out_y = _mm256_blendv_pd(_mm256_add_pd(ay, _mm256_mul_pd(last, uy)), by, out_at_b);
  _mm256_storeu_pd(&cut.in_x[g], in_x);
  _mm256_storeu_pd(&cut.in_y[g], in_y);
  _mm256_storeu_pd(&cut.out_x[g], out_x);
  _mm256_storeu_pd(&cut.out_y[g], out_y);
  const __m256d pivot_x = _mm256_broadcast_sd(&cutter.pivot_x),
                pivot_y = _mm256_broadcast_sd(&cutter.pivot_y);
  const __m256d area = cross(_mm256_sub_pd(in_x, pivot_x), _mm256_sub_pd(in_y, pivot_y),
                             _mm256_sub_pd(out_x, pivot_x), _mm256_sub_pd(out_y, pivot_y));
  twice_area = _mm256_blendv_pd(twice_area, _mm256_add_pd(twice_area, area), lanes_of(four.inside));
}

/// Cuts the segments from number g on. Stops early if they are all of the region and all outside
/// one line.
TRANSILLUM_AVX2 inline InsideParts cut_four(const BoundarySegments& region, std::size_t g,
                                            const Cutter& cutter, BoundaryCut& cut,
                                            LineCrossings& lines, __m256d& twice_area) {
  Four four;
  load_four(region, g, four);
  for (std::size_t m = 0; m < cutter.count; ++m) {
    if (!clip_by_line(cutter, m, g, four, lines[m]) && region.count <= 4) {
      return {};
    }
  }
  four.inside &= bits_of(_mm256_cmp_pd(four.first, four.last, _CMP_LE_OQ));
  if (four.inside != 0) {
    find_ends(cutter.count, g, four, cut);
    store_inside(four, g, cutter, cut, twice_area);
  }
  return {four.inside, four.starts, four.ends};
}

/// Appends, of four segments, the parts before their inside parts, and those without an inside
/// part.
TRANSILLUM_AVX2 inline void append_before(const BoundarySegments& region, std::size_t g,
                                          const InsideParts& parts, const BoundaryCut& cut,
                                          BoundarySegments& outside) {
  const unsigned chosen = (filled(region.count, g) & ~parts.inside) | parts.starts;
  const __m256d inside = lanes_of(parts.inside);
  append(outside, chosen, _mm256_load_pd(&region.ax[g]), _mm256_load_pd(&region.ay[g]),
         _mm256_blendv_pd(_mm256_load_pd(&region.bx[g]), _mm256_loadu_pd(&cut.in_x[g]), inside),
         _mm256_blendv_pd(_mm256_load_pd(&region.by[g]), _mm256_loadu_pd(&cut.in_y[g]), inside));
}

/// Appends the parts after their inside parts.
TRANSILLUM_AVX2 inline void append_after(const BoundarySegments& region, std::size_t g,
                                         const InsideParts& parts, const BoundaryCut& cut,
                                         BoundarySegments& outside) {
  append(outside, parts.ends, _mm256_loadu_pd(&cut.out_x[g]), _mm256_loadu_pd(&cut.out_y[g]),
         _mm256_load_pd(&region.bx[g]), _mm256_load_pd(&region.by[g]));
}

TRANSILLUM_AVX2 bool cut_avx2(const BoundarySegments& region, const Cutter& cutter,
                              BoundaryCut& cut, BoundarySegments& outside) {
  LineCrossings lines;
  reset(lines, cut, cutter.count);
  __m256d twice_area[2] = {_mm256_setzero_pd(), _mm256_setzero_pd()};
  outside.count = 0;
  for (std::size_t g = 0; g < region.count; g += 8) {
    const bool both = g + 4 < region.count;
    const InsideParts low = cut_four(region, g, cutter, cut, lines, twice_area[0]);
    const InsideParts high =
        both ? cut_four(region, g + 4, cutter, cut, lines, twice_area[1]) : InsideParts{};
    cut.inside |= static_cast<std::uint64_t>(low.inside | high.inside << 4) << g;
    append_before(region, g, low, cut, outside);
    if (both) {
      append_before(region, g + 4, high, cut, outside);
    }
    if (low.ends != 0) {
      append_after(region, g, low, cut, outside);
    }
    if (high.ends != 0) {
      append_after(region, g + 4, high, cut, outside);
    }
  }
  if (is_outside(lines, cutter.count)) {
    return false;
  }
  std::array<double, 8> by_lane;
  _mm256_storeu_pd(by_lane.data(), twice_area[0]);
  _mm256_storeu_pd(by_lane.data() + 4, twice_area[1]);
  cut.twice_area = sum_of_eight(by_lane);
  find_windings(lines, cutter.count, cut);
  return true;
}

/// The largest lane.
TRANSILLUM_AVX2 inline double largest(__m256d v) {
  const __m128d pair = _mm_max_pd(_mm256_castpd256_pd128(v), _mm256_extractf128_pd(v, 1));
  return _mm_cvtsd_f64(_mm_max_sd(pair, _mm_unpackhi_pd(pair, pair)));
}

TRANSILLUM_AVX2 Extent extent_avx2(const BoundarySegments& region) {
  const __m256d none = _mm256_set1_pd(-HUGE_VAL), zero = _mm256_setzero_pd();
  __m256d most[8];
  for (__m256d& m : most) {
    m = none;
  }
  for (std::size_t g = 0; g < region.count; g += 4) {
    const __m256d all = lanes_of(filled(region.count, g));
    const __m256d x = _mm256_load_pd(&region.ax[g]), y = _mm256_load_pd(&region.ay[g]);
    const __m256d along[4] = {x, y, _mm256_add_pd(x, y), _mm256_sub_pd(x, y)};
    for (std::size_t d = 0; d < 4; ++d) {
      most[d] = _mm256_max_pd(most[d], _mm256_blendv_pd(none, along[d], all));
      most[d + 4] =
          _mm256_max_pd(most[d + 4], _mm256_blendv_pd(none, _mm256_sub_pd(zero, along[d]), all));
    }
  }
  Extent extent;
  for (std::size_t d = 0; d < 8; ++d) {
    extent[d] = largest(most[d]);
  }
  return extent;
}

}  // namespace

SimdBackend avx2_backend() { return {"AVX2", scalar_backend().set, cut_avx2, extent_avx2}; }

}  // namespace transillum
#endif
