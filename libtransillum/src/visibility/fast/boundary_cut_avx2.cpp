// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of the fast engine, four segments at once: for processors without AVX-512.
#if defined(__x86_64__)
#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "visibility/fast/simd_backend.h"

#define TRANSILLUM_AVX2 __attribute__((target("avx2,popcnt")))

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

/// For each choice of lanes the halves of those chosen, in order.
constexpr std::array<std::array<int, 8>, 16> packed_halves = [] {
  std::array<std::array<int, 8>, 16> halves{};
  for (std::size_t bits = 0; bits < 16; ++bits) {
    std::size_t at = 0;
    for (int lane = 0; lane < 4; ++lane) {
      if ((bits >> lane & 1) == 0) {
        continue;
      }
      halves[bits][at++] = 2 * lane;
      halves[bits][at++] = 2 * lane + 1;
    }
  }
  return halves;
}();

TRANSILLUM_AVX2 inline __m256d packed(__m256d v, __m256i halves) {
  return _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(v), halves));
}

/// Appends the segments from a to b that `chosen` tells.
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

/// Of four segments, a bit each.
struct Four {
  unsigned inside, starts, ends;
};

/// Cuts the segments from `g` on, and notes what crosses which line.
TRANSILLUM_AVX2 inline Four cut_four(const BoundarySegments& outline, std::size_t g,
                                     const Cutter& cutter, BoundaryCut& cut, LineCrossings& lines,
                                     __m256d& twice_area) {
  const __m256d zero = _mm256_setzero_pd(), one = _mm256_set1_pd(1);
  const unsigned all = filled(outline.count, g);
  const __m256d all_lanes = lanes_of(all);
  const __m256d ax = _mm256_load_pd(&outline.ax[g]), ay = _mm256_load_pd(&outline.ay[g]);
  const __m256d bx = _mm256_load_pd(&outline.bx[g]), by = _mm256_load_pd(&outline.by[g]);
  const __m256d ux = _mm256_sub_pd(bx, ax), uy = _mm256_sub_pd(by, ay);
  __m256d first = zero, last = one;
  Four four{all, 0, 0};
  std::array<unsigned, Cutter::max_edges> first_by, last_by;
  for (std::size_t m = 0; m < cutter.count; ++m) {
    const __m256d dx = _mm256_broadcast_sd(&cutter.dx[m]), dy = _mm256_broadcast_sd(&cutter.dy[m]);
    const __m256d c = _mm256_broadcast_sd(&cutter.c[m]);
    const __m256d high = _mm256_set1_pd(cutter.tolerance * cutter.length[m]),
                  low = _mm256_sub_pd(zero, high);
    const __m256d a = _mm256_add_pd(cross(dx, dy, ax, ay), c);
    const __m256d b = _mm256_add_pd(cross(dx, dy, bx, by), c);
    const __m256d a_in = _mm256_and_pd(all_lanes, _mm256_cmp_pd(a, low, _CMP_GE_OQ));
    const __m256d b_in = _mm256_and_pd(all_lanes, _mm256_cmp_pd(b, low, _CMP_GE_OQ));
    const unsigned a_bits = bits_of(a_in), b_bits = bits_of(b_in);
    four.inside &= a_bits | b_bits;
    if (outline.count <= 4 && (a_bits | b_bits) == 0) {
      return four;
    }
    lines[m].inner |= a_bits | b_bits;
    first_by[m] = last_by[m] = 0;
    if (a_bits == b_bits) {
      continue;
    }
    const __m256d out = _mm256_andnot_pd(b_in, a_in), in = _mm256_andnot_pd(a_in, b_in);
    __m256d t = _mm256_div_pd(a, _mm256_sub_pd(a, b));
    t = _mm256_blendv_pd(t, zero, _mm256_and_pd(out, _mm256_cmp_pd(a, high, _CMP_LE_OQ)));
    t = _mm256_blendv_pd(t, one, _mm256_and_pd(in, _mm256_cmp_pd(b, high, _CMP_LE_OQ)));
    const __m256d later = _mm256_and_pd(in, _mm256_cmp_pd(t, first, _CMP_GT_OQ));
    const __m256d sooner = _mm256_and_pd(out, _mm256_cmp_pd(t, last, _CMP_LT_OQ));
    first = _mm256_blendv_pd(first, t, later);
    last = _mm256_blendv_pd(last, t, sooner);
    first_by[m] = bits_of(later);
    last_by[m] = bits_of(sooner);
    const __m256d along = _mm256_add_pd(dot(dx, dy, ax, ay), _mm256_mul_pd(t, dot(dx, dy, ux, uy)));
    const unsigned nearer =
        bits_of(_mm256_cmp_pd(along, _mm256_broadcast_sd(&cutter.middle[m]), _CMP_LT_OQ));
    lines[m].out |= std::uint64_t{a_bits & ~b_bits} << g;
    lines[m].in |= std::uint64_t{b_bits & ~a_bits} << g;
    lines[m].low |= std::uint64_t{nearer} << g;
  }
  four.inside &= bits_of(_mm256_cmp_pd(first, last, _CMP_LE_OQ));
  if (four.inside == 0) {
    return four;
  }
  // The line that came last as the first, and so on, is the one.
  unsigned no_first = four.inside, no_last = four.inside;
  for (std::size_t m = cutter.count; m-- > 0;) {
    cut.enters[m] |= std::uint64_t{first_by[m] & no_first} << g;
    cut.leaves[m] |= std::uint64_t{last_by[m] & no_last} << g;
    no_first &= ~first_by[m];
    no_last &= ~last_by[m];
  }
  four.starts = four.inside & ~no_first;
  four.ends = four.inside & ~no_last;
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
  return four;
}

/// What of four segments comes before their parts inside, or all of those that have none.
TRANSILLUM_AVX2 inline void append_before(const BoundarySegments& outline, std::size_t g,
                                          const Four& four, const BoundaryCut& cut,
                                          BoundarySegments& outside) {
  const unsigned chosen = (filled(outline.count, g) & ~four.inside) | four.starts;
  const __m256d inside = lanes_of(four.inside);
  append(outside, chosen, _mm256_load_pd(&outline.ax[g]), _mm256_load_pd(&outline.ay[g]),
         _mm256_blendv_pd(_mm256_load_pd(&outline.bx[g]), _mm256_loadu_pd(&cut.in_x[g]), inside),
         _mm256_blendv_pd(_mm256_load_pd(&outline.by[g]), _mm256_loadu_pd(&cut.in_y[g]), inside));
}

TRANSILLUM_AVX2 inline void append_behind(const BoundarySegments& outline, std::size_t g,
                                          const Four& four, const BoundaryCut& cut,
                                          BoundarySegments& outside) {
  append(outside, four.ends, _mm256_loadu_pd(&cut.out_x[g]), _mm256_loadu_pd(&cut.out_y[g]),
         _mm256_load_pd(&outline.bx[g]), _mm256_load_pd(&outline.by[g]));
}

TRANSILLUM_AVX2 bool cut_avx2(const BoundarySegments& outline, const Cutter& cutter,
                              BoundaryCut& cut, BoundarySegments& outside) {
  LineCrossings lines;
  for (std::size_t m = 0; m < cutter.count; ++m) {
    lines[m] = {};
    cut.enters[m] = cut.leaves[m] = 0;
  }
  __m256d twice_area[2] = {_mm256_setzero_pd(), _mm256_setzero_pd()};
  outside.count = 0;
  for (std::size_t g = 0; g < outline.count; g += 8) {
    const bool both = g + 4 < outline.count;
    const Four low = cut_four(outline, g, cutter, cut, lines, twice_area[0]);
    const Four high = both ? cut_four(outline, g + 4, cutter, cut, lines, twice_area[1]) : Four{};
    append_before(outline, g, low, cut, outside);
    if (both) {
      append_before(outline, g + 4, high, cut, outside);
    }
    if (low.ends != 0) {
      append_behind(outline, g, low, cut, outside);
    }
    if (high.ends != 0) {
      append_behind(outline, g + 4, high, cut, outside);
    }
  }
  for (std::size_t m = 0; m < cutter.count; ++m) {
    if (lines[m].inner == 0) {
      return false;
    }
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

TRANSILLUM_AVX2 Extent extent_avx2(const BoundarySegments& outline) {
  const __m256d none = _mm256_set1_pd(-HUGE_VAL), zero = _mm256_setzero_pd();
  __m256d most[8];
  for (__m256d& m : most) {
    m = none;
  }
  for (std::size_t g = 0; g < outline.count; g += 4) {
    const __m256d all = lanes_of(filled(outline.count, g));
    const __m256d x = _mm256_load_pd(&outline.ax[g]), y = _mm256_load_pd(&outline.ay[g]);
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

SimdBackend avx2_backend() { return {"by four", scalar_backend().set, cut_avx2, extent_avx2}; }

}  // namespace transillum
#endif
