// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of the fast engine, eight segments at once.
#if defined(__x86_64__)
#include <immintrin.h>

#include <bit>
#include <cmath>

#include "visibility/fast/simd_backend.h"

#define TRANSILLUM_AVX512 __attribute__((target("avx512f,avx512dq,popcnt")))

namespace transillum {
namespace {

__mmask8 filled(std::size_t count, std::size_t from) {
  return static_cast<__mmask8>(count - from >= 8 ? 0xffU : (1U << (count - from)) - 1U);
}

/// Up to eight of `count` points; no more is read.
TRANSILLUM_AVX512 inline void load_points(const GridPoint* points, std::size_t count, __m512i& x,
                                          __m512i& y) {
  const __m512i low = _mm512_maskz_loadu_epi64(filled(2 * count, 0), points);
  const __m512i high = count > 4 ? _mm512_maskz_loadu_epi64(filled(2 * count, 8), points + 4)
                                 : _mm512_setzero_si512();
  x = _mm512_permutex2var_epi64(low, _mm512_set_epi64(14, 12, 10, 8, 6, 4, 2, 0), high);
  y = _mm512_permutex2var_epi64(low, _mm512_set_epi64(15, 13, 11, 9, 7, 5, 3, 1), high);
}

/// Appends the segments from a to b that `chosen` tells.
TRANSILLUM_AVX512 inline void append(BoundarySegments& to, __mmask8 chosen, __m512d ax, __m512d ay,
                                     __m512d bx, __m512d by) {
  const std::size_t k = to.count;
  _mm512_storeu_pd(&to.ax[k], _mm512_maskz_compress_pd(chosen, ax));
  _mm512_storeu_pd(&to.ay[k], _mm512_maskz_compress_pd(chosen, ay));
  _mm512_storeu_pd(&to.bx[k], _mm512_maskz_compress_pd(chosen, bx));
  _mm512_storeu_pd(&to.by[k], _mm512_maskz_compress_pd(chosen, by));
  to.count += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(chosen)));
}

TRANSILLUM_AVX512 inline __m512d dot(__m512d ax, __m512d ay, __m512d bx, __m512d by) {
  return _mm512_add_pd(_mm512_mul_pd(ax, bx), _mm512_mul_pd(ay, by));
}
TRANSILLUM_AVX512 inline __m512d cross(__m512d ax, __m512d ay, __m512d bx, __m512d by) {
  return _mm512_sub_pd(_mm512_mul_pd(ax, by), _mm512_mul_pd(ay, bx));
}

TRANSILLUM_AVX512 void set_avx512(Cutter& cutter, const GridPoint* corners, std::size_t count,
                                  const GridPoint& origin, double far) {
  cutter.count = count;
  const __m512i origin_x = _mm512_set1_epi64(origin.x), origin_y = _mm512_set1_epi64(origin.y);
  const __m512i first_x = _mm512_set1_epi64(corners[0].x),
                first_y = _mm512_set1_epi64(corners[0].y);
  const __m512d half = _mm512_set1_pd(0.5), limit = _mm512_set1_pd(far);
  __m512d perimeter = _mm512_setzero_pd();
  unsigned any_far = 0;
  for (std::size_t g = 0; g < count; g += 8) {
    const __mmask8 all = filled(count, g);
    __m512i ax, ay, bx, by;
    load_points(corners + g, count - g, ax, ay);
    load_points(corners + g + 1, count - g - 1, bx, by);
    if (count - g <= 8) {
      const auto last = static_cast<__mmask8>(1U << (count - g - 1));
      bx = _mm512_mask_mov_epi64(bx, last, first_x);
      by = _mm512_mask_mov_epi64(by, last, first_y);
    }
    const __m512d x = _mm512_cvtepi64_pd(_mm512_sub_epi64(ax, origin_x));
    const __m512d y = _mm512_cvtepi64_pd(_mm512_sub_epi64(ay, origin_y));
    const __m512d dx = _mm512_cvtepi64_pd(_mm512_sub_epi64(bx, ax));
    const __m512d dy = _mm512_cvtepi64_pd(_mm512_sub_epi64(by, ay));
    const __m512d length = _mm512_add_pd(_mm512_abs_pd(dx), _mm512_abs_pd(dy));
    _mm512_store_pd(&cutter.x[g], x);
    _mm512_store_pd(&cutter.y[g], y);
    _mm512_store_pd(&cutter.dx[g], dx);
    _mm512_store_pd(&cutter.dy[g], dy);
    _mm512_store_pd(&cutter.c[g], cross(dy, dx, y, x));
    _mm512_store_pd(&cutter.middle[g],
                    _mm512_add_pd(dot(dx, dy, x, y), _mm512_mul_pd(half, dot(dx, dy, dx, dy))));
    _mm512_store_pd(&cutter.length[g], length);
    perimeter = _mm512_mask_add_pd(perimeter, all, perimeter, length);
    any_far |= _mm512_mask_cmp_pd_mask(all, _mm512_add_pd(_mm512_abs_pd(x), _mm512_abs_pd(y)),
                                       limit, _CMP_GT_OQ);
  }
  std::array<double, 8> by_lane;
  _mm512_storeu_pd(by_lane.data(), perimeter);
  cutter.perimeter = sum_of_eight(by_lane);
  if (any_far != 0) {
    recompute_far_lines(cutter, corners, origin, far);
  }
}

/// `one_vector` says that there are no more than eight segments.
template <bool one_vector>
TRANSILLUM_AVX512 inline bool cut_vectors(const BoundarySegments& outline, const Cutter& cutter,
                                          BoundaryCut& cut, BoundarySegments& outside) {
  const std::size_t line_count = cutter.count;
  LineCrossings lines;
  for (std::size_t m = 0; m < line_count; ++m) {
    lines[m] = {};
    cut.enters[m] = cut.leaves[m] = 0;
  }
  const __m512d zero = _mm512_setzero_pd(), one = _mm512_set1_pd(1);
  const __m512d pivot_x = _mm512_set1_pd(cutter.pivot_x), pivot_y = _mm512_set1_pd(cutter.pivot_y);
  __m512d twice_area = zero;
  outside.count = 0;
  for (std::size_t g = 0; g < (one_vector ? 1 : outline.count); g += 8) {
    const __mmask8 all = filled(outline.count, g);
    const __m512d ax = _mm512_load_pd(&outline.ax[g]), ay = _mm512_load_pd(&outline.ay[g]);
    const __m512d bx = _mm512_load_pd(&outline.bx[g]), by = _mm512_load_pd(&outline.by[g]);
    const __m512d ux = _mm512_sub_pd(bx, ax), uy = _mm512_sub_pd(by, ay);
    __m512d first = zero, last = one;
    __mmask8 inside = all;
    std::array<__mmask8, Cutter::max_edges> first_by, last_by;
    for (std::size_t m = 0; m < line_count; ++m) {
      const __m512d dx = _mm512_set1_pd(cutter.dx[m]), dy = _mm512_set1_pd(cutter.dy[m]);
      const __m512d c = _mm512_set1_pd(cutter.c[m]);
      const __m512d high = _mm512_set1_pd(cutter.tolerance * cutter.length[m]),
                    low = _mm512_sub_pd(zero, high);
      const __m512d a = _mm512_add_pd(cross(dx, dy, ax, ay), c);
      const __m512d b = _mm512_add_pd(cross(dx, dy, bx, by), c);
      const __mmask8 a_in = _mm512_mask_cmp_pd_mask(all, a, low, _CMP_GE_OQ);
      const __mmask8 b_in = _mm512_mask_cmp_pd_mask(all, b, low, _CMP_GE_OQ);
      const __mmask8 inner = a_in | b_in;
      if (one_vector && inner == 0) {
        return false;
      }
      inside &= inner;
      lines[m].inner |= inner;
      const __mmask8 out = a_in & static_cast<__mmask8>(~b_in);
      const __mmask8 in = b_in & static_cast<__mmask8>(~a_in);
      first_by[m] = last_by[m] = 0;
      if ((out | in) == 0) {
        continue;
      }
      __m512d t = _mm512_div_pd(a, _mm512_sub_pd(a, b));
      t = _mm512_mask_mov_pd(t, _mm512_mask_cmp_pd_mask(out, a, high, _CMP_LE_OQ), zero);
      t = _mm512_mask_mov_pd(t, _mm512_mask_cmp_pd_mask(in, b, high, _CMP_LE_OQ), one);
      first_by[m] = _mm512_mask_cmp_pd_mask(in, t, first, _CMP_GT_OQ);
      last_by[m] = _mm512_mask_cmp_pd_mask(out, t, last, _CMP_LT_OQ);
      first = _mm512_mask_mov_pd(first, first_by[m], t);
      last = _mm512_mask_mov_pd(last, last_by[m], t);
      const __m512d along =
          _mm512_add_pd(dot(dx, dy, ax, ay), _mm512_mul_pd(t, dot(dx, dy, ux, uy)));
      const __mmask8 nearer =
          _mm512_cmp_pd_mask(along, _mm512_set1_pd(cutter.middle[m]), _CMP_LT_OQ);
      lines[m].out |= static_cast<std::uint64_t>(out) << g;
      lines[m].in |= static_cast<std::uint64_t>(in) << g;
      lines[m].low |= static_cast<std::uint64_t>(nearer) << g;
    }
    inside = _mm512_mask_cmp_pd_mask(inside, first, last, _CMP_LE_OQ);
    // The line that came last as the first, and so on, is the one.
    __mmask8 no_first = inside, no_last = inside;
    for (std::size_t m = line_count; m-- > 0;) {
      cut.enters[m] |= static_cast<std::uint64_t>(first_by[m] & no_first) << g;
      cut.leaves[m] |= static_cast<std::uint64_t>(last_by[m] & no_last) << g;
      no_first &= static_cast<__mmask8>(~first_by[m]);
      no_last &= static_cast<__mmask8>(~last_by[m]);
    }
    const auto starts = static_cast<__mmask8>(inside & ~no_first);
    const auto ends = static_cast<__mmask8>(inside & ~no_last);
    const __mmask8 before_b = _mm512_cmp_pd_mask(first, one, _CMP_LT_OQ);
    const __mmask8 out_before_b = _mm512_cmp_pd_mask(last, one, _CMP_LT_OQ);
    const __m512d in_x = _mm512_mask_add_pd(bx, before_b, ax, _mm512_mul_pd(first, ux));
    const __m512d in_y = _mm512_mask_add_pd(by, before_b, ay, _mm512_mul_pd(first, uy));
    const __m512d out_x = _mm512_mask_add_pd(bx, out_before_b, ax, _mm512_mul_pd(last, ux));
    const __m512d out_y = _mm512_mask_add_pd(by, out_before_b, ay, _mm512_mul_pd(last, uy));
    _mm512_storeu_pd(&cut.in_x[g], in_x);
    _mm512_storeu_pd(&cut.in_y[g], in_y);
    _mm512_storeu_pd(&cut.out_x[g], out_x);
    _mm512_storeu_pd(&cut.out_y[g], out_y);
    twice_area =
        _mm512_mask_add_pd(twice_area, inside, twice_area,
                           cross(_mm512_sub_pd(in_x, pivot_x), _mm512_sub_pd(in_y, pivot_y),
                                 _mm512_sub_pd(out_x, pivot_x), _mm512_sub_pd(out_y, pivot_y)));
    append(outside, static_cast<__mmask8>((all & ~inside) | starts), ax, ay,
           _mm512_mask_mov_pd(bx, inside, in_x), _mm512_mask_mov_pd(by, inside, in_y));
    append(outside, ends, out_x, out_y, bx, by);
  }
  for (std::size_t m = 0; m < line_count; ++m) {
    if (lines[m].inner == 0) {
      return false;
    }
  }
  std::array<double, 8> by_lane;
  _mm512_storeu_pd(by_lane.data(), twice_area);
  cut.twice_area = sum_of_eight(by_lane);
  find_windings(lines, line_count, cut);
  return true;
}

TRANSILLUM_AVX512 bool cut_avx512(const BoundarySegments& outline, const Cutter& cutter,
                                  BoundaryCut& cut, BoundarySegments& outside) {
  return outline.count <= 8 ? cut_vectors<true>(outline, cutter, cut, outside)
                            : cut_vectors<false>(outline, cutter, cut, outside);
}

/// All lanes, spelled out: of the intrinsics that need no mask GCC 12 warns.
constexpr __mmask8 each = 0xff;

/// The larger one of the first and second, and of the third and last two lanes of a, then of b.
TRANSILLUM_AVX512 inline __m512d larger_quarters(__m512d a, __m512d b) {
  return _mm512_maskz_max_pd(each, _mm512_maskz_shuffle_f64x2(each, a, b, 0x88),
                             _mm512_maskz_shuffle_f64x2(each, a, b, 0xdd));
}

TRANSILLUM_AVX512 Extent extent_avx512(const BoundarySegments& outline) {
  const __m512d zero = _mm512_setzero_pd();
  __m512d most[8];
  for (__m512d& m : most) {
    m = _mm512_set1_pd(-HUGE_VAL);
  }
  for (std::size_t g = 0; g < outline.count; g += 8) {
    const __mmask8 all = filled(outline.count, g);
    const __m512d x = _mm512_load_pd(&outline.ax[g]), y = _mm512_load_pd(&outline.ay[g]);
    const __m512d along[4] = {x, y, _mm512_add_pd(x, y), _mm512_sub_pd(x, y)};
    for (std::size_t d = 0; d < 4; ++d) {
      most[d] = _mm512_mask_max_pd(most[d], all, most[d], along[d]);
      most[d + 4] =
          _mm512_mask_max_pd(most[d + 4], all, most[d + 4], _mm512_sub_pd(zero, along[d]));
    }
  }
  // Lanes of two vectors into one of half as many of each, until eight vectors are one.
  __m512d four[4], two[2];
  for (std::size_t k = 0; k < 4; ++k) {
    const __m512d a = most[2 * k], b = most[2 * k + 1];
    four[k] = _mm512_maskz_max_pd(each, _mm512_maskz_unpacklo_pd(each, a, b),
                                  _mm512_maskz_unpackhi_pd(each, a, b));
  }
  two[0] = larger_quarters(four[0], four[1]);
  two[1] = larger_quarters(four[2], four[3]);
  Extent extent;
  _mm512_storeu_pd(extent.data(), larger_quarters(two[0], two[1]));
  return extent;
}

}  // namespace

SimdBackend avx512_backend() { return {"by eight", set_avx512, cut_avx512, extent_avx512}; }

}  // namespace transillum
#endif
