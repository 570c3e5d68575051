// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of engine fast with AVX-512, eight segments at once: the same steps as
// boundary_cut_scalar.cpp, lane by lane.
//
// Notation: g is the number of the first of the eight segments, m a line of the cutter.
#if defined(__x86_64__)
#include <immintrin.h>

#include <bit>
#include <cmath>

#include "visibility/queries/simd_backend.h"

#define TRANSILLUM_AVX512 __attribute__((target("avx512f,avx512dq,popcnt")))
#define TRANSILLUM_AVX512_INLINE TRANSILLUM_AVX512 __attribute__((always_inline)) inline

namespace transillum {
namespace {

__mmask8 filled(std::size_t count, std::size_t from) {
  return static_cast<__mmask8>(count - from >= 8 ? 0xffU : (1U << (count - from)) - 1U);
}

/// Loads up to eight of `count` points; does not read beyond them.
TRANSILLUM_AVX512 inline void load_points(const GridPoint* points, std::size_t count, __m512i& x,
                                          __m512i& y) {
  const __m512i low = _mm512_maskz_loadu_epi64(filled(2 * count, 0), points);
  const __m512i high = count > 4 ? _mm512_maskz_loadu_epi64(filled(2 * count, 8), points + 4)
                                 : _mm512_setzero_si512();
  x = _mm512_permutex2var_epi64(low, _mm512_set_epi64(14, 12, 10, 8, 6, 4, 2, 0), high);
  y = _mm512_permutex2var_epi64(low, _mm512_set_epi64(15, 13, 11, 9, 7, 5, 3, 1), high);
}

/// Appends the segments from a to b of the lanes in `chosen`.
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

/// Eight segments, clipped by the lines of the cutter one after another. The part of a segment
/// inside the lines so far runs from a + first u to a + last u.
struct Eight {
  __mmask8 all;     ///< lanes in use
  __mmask8 inside;  ///< lanes with a part inside
  __mmask8 starts;  ///< lanes whose inside part starts on a line
  __mmask8 ends;    ///< lanes whose inside part ends on a line
  __m512d ax, ay, bx, by;
  __m512d ux, uy;  ///< b - a
  __m512d first, last;
  /// Per line of the cutter: lanes whose `first` or `last` the line has changed.
  std::array<__mmask8, Cutter::max_edges> first_by, last_by;
};

/// Loads the segments from number g on.
TRANSILLUM_AVX512_INLINE void load_eight(const BoundarySegments& region, std::size_t g,
                                         Eight& eight) {
  eight.all = eight.inside = filled(region.count, g);
  eight.ax = _mm512_load_pd(&region.ax[g]);
  eight.ay = _mm512_load_pd(&region.ay[g]);
  eight.bx = _mm512_load_pd(&region.bx[g]);
  eight.by = _mm512_load_pd(&region.by[g]);
  eight.ux = _mm512_sub_pd(eight.bx, eight.ax);
  eight.uy = _mm512_sub_pd(eight.by, eight.ay);
  eight.first = _mm512_setzero_pd();
  eight.last = _mm512_set1_pd(1);
}

/// Clips the segments, those from number g on, by line m. Returns false if none of them has a point
/// on its inner side.
TRANSILLUM_AVX512_INLINE bool clip_by_line(const Cutter& cutter, std::size_t m, std::size_t g,
                                           Eight& eight, Crossings& crossings) {
  const __m512d zero = _mm512_setzero_pd(), one = _mm512_set1_pd(1);
  const __m512d dx = _mm512_set1_pd(cutter.dx[m]), dy = _mm512_set1_pd(cutter.dy[m]);
  const __m512d c = _mm512_set1_pd(cutter.c[m]);
  const __m512d high = _mm512_set1_pd(cutter.tolerance * cutter.length[m]),
                low = _mm512_sub_pd(zero, high);
  const __m512d a = _mm512_add_pd(cross(dx, dy, eight.ax, eight.ay), c);
  const __m512d b = _mm512_add_pd(cross(dx, dy, eight.bx, eight.by), c);
  const __mmask8 a_in = _mm512_mask_cmp_pd_mask(eight.all, a, low, _CMP_GE_OQ);
  const __mmask8 b_in = _mm512_mask_cmp_pd_mask(eight.all, b, low, _CMP_GE_OQ);
  const __mmask8 inner = a_in | b_in;
  eight.inside &= inner;
  crossings.inner |= inner;
  const __mmask8 out = a_in & static_cast<__mmask8>(~b_in);
  const __mmask8 in = b_in & static_cast<__mmask8>(~a_in);
  eight.first_by[m] = eight.last_by[m] = 0;
  if ((out | in) == 0) {
    return inner != 0;
  }
  __m512d t = _mm512_div_pd(a, _mm512_sub_pd(a, b));
  t = _mm512_mask_mov_pd(t, _mm512_mask_cmp_pd_mask(out, a, high, _CMP_LE_OQ), zero);
  t = _mm512_mask_mov_pd(t, _mm512_mask_cmp_pd_mask(in, b, high, _CMP_LE_OQ), one);
  eight.first_by[m] = _mm512_mask_cmp_pd_mask(in, t, eight.first, _CMP_GT_OQ);
  eight.last_by[m] = _mm512_mask_cmp_pd_mask(out, t, eight.last, _CMP_LT_OQ);
  eight.first = _mm512_mask_mov_pd(eight.first, eight.first_by[m], t);
  eight.last = _mm512_mask_mov_pd(eight.last, eight.last_by[m], t);
  const __m512d along = _mm512_add_pd(dot(dx, dy, eight.ax, eight.ay),
                                      _mm512_mul_pd(t, dot(dx, dy, eight.ux, eight.uy)));
  const __mmask8 nearer = _mm512_cmp_pd_mask(along, _mm512_set1_pd(cutter.middle[m]), _CMP_LT_OQ);
  crossings.out |= static_cast<std::uint64_t>(out) << g;
  crossings.in |= static_cast<std::uint64_t>(in) << g;
  crossings.low |= static_cast<std::uint64_t>(nearer) << g;
  return true;
}

/// Finds the lines on which the inside parts start and end, after clipping by all lines: of those
/// that changed `first` or `last`, the last one.
TRANSILLUM_AVX512_INLINE void find_ends(std::size_t line_count, std::size_t g, Eight& eight,
                                        BoundaryCut& cut) {
  eight.inside = _mm512_mask_cmp_pd_mask(eight.inside, eight.first, eight.last, _CMP_LE_OQ);
  __mmask8 no_first = eight.inside, no_last = eight.inside;
  for (std::size_t m = line_count; m-- > 0;) {
    cut.enters[m] |= static_cast<std::uint64_t>(eight.first_by[m] & no_first) << g;
    cut.leaves[m] |= static_cast<std::uint64_t>(eight.last_by[m] & no_last) << g;
    no_first &= static_cast<__mmask8>(~eight.first_by[m]);
    no_last &= static_cast<__mmask8>(~eight.last_by[m]);
  }
  eight.starts = static_cast<__mmask8>(eight.inside & ~no_first);
  eight.ends = static_cast<__mmask8>(eight.inside & ~no_last);
}

/// Stores the inside parts in `cut`, appends the outside parts to `outside`, and returns
/// `twice_area` plus the contributions of the inside parts.
TRANSILLUM_AVX512_INLINE __m512d store_parts(const Eight& eight, std::size_t g,
                                             const Cutter& cutter, __m512d twice_area,
                                             BoundaryCut& cut, BoundarySegments& outside) {
  const __m512d one = _mm512_set1_pd(1);
  const __m512d pivot_x = _mm512_set1_pd(cutter.pivot_x), pivot_y = _mm512_set1_pd(cutter.pivot_y);
  const __mmask8 before_b = _mm512_cmp_pd_mask(eight.first, one, _CMP_LT_OQ);
  const __mmask8 out_before_b = _mm512_cmp_pd_mask(eight.last, one, _CMP_LT_OQ);
  const __m512d in_x =
      _mm512_mask_add_pd(eight.bx, before_b, eight.ax, _mm512_mul_pd(eight.first, eight.ux));
  const __m512d in_y =
      _mm512_mask_add_pd(eight.by, before_b, eight.ay, _mm512_mul_pd(eight.first, eight.uy));
  const __m512d out_x =
      _mm512_mask_add_pd(eight.bx, out_before_b, eight.ax, _mm512_mul_pd(eight.last, eight.ux));
  const __m512d out_y =
      _mm512_mask_add_pd(eight.by, out_before_b, eight.ay, _mm512_mul_pd(eight.last, eight.uy));
  _mm512_storeu_pd(&cut.in_x[g], in_x);
  _mm512_storeu_pd(&cut.in_y[g], in_y);
  _mm512_storeu_pd(&cut.out_x[g], out_x);
  _mm512_storeu_pd(&cut.out_y[g], out_y);
  append(outside, static_cast<__mmask8>((eight.all & ~eight.inside) | eight.starts), eight.ax,
         eight.ay, _mm512_mask_mov_pd(eight.bx, eight.inside, in_x),
         _mm512_mask_mov_pd(eight.by, eight.inside, in_y));
  append(outside, eight.ends, out_x, out_y, eight.bx, eight.by);
  return _mm512_mask_add_pd(twice_area, eight.inside, twice_area,
                            cross(_mm512_sub_pd(in_x, pivot_x), _mm512_sub_pd(in_y, pivot_y),
                                  _mm512_sub_pd(out_x, pivot_x), _mm512_sub_pd(out_y, pivot_y)));
}

/// @tparam one_vector there are at most eight segments
template <bool one_vector>
TRANSILLUM_AVX512 inline bool cut_vectors(const BoundarySegments& region, const Cutter& cutter,
                                          BoundaryCut& cut, BoundarySegments& outside) {
  const std::size_t line_count = cutter.count;
  LineCrossings lines;
  reset(lines, cut, line_count);
  __m512d twice_area = _mm512_setzero_pd();
  outside.count = 0;
  for (std::size_t g = 0; g < (one_vector ? 1 : region.count); g += 8) {
    Eight eight;
    load_eight(region, g, eight);
    for (std::size_t m = 0; m < line_count; ++m) {
      if (!clip_by_line(cutter, m, g, eight, lines[m]) && one_vector) {
        return false;
      }
    }
    find_ends(line_count, g, eight, cut);
    cut.inside |= static_cast<std::uint64_t>(eight.inside) << g;
    twice_area = store_parts(eight, g, cutter, twice_area, cut, outside);
  }
  if (is_outside(lines, line_count)) {
    return false;
  }
  std::array<double, 8> by_lane;
  _mm512_storeu_pd(by_lane.data(), twice_area);
  cut.twice_area = sum_of_eight(by_lane);
  find_windings(lines, line_count, cut);
  return true;
}

TRANSILLUM_AVX512 bool cut_avx512(const BoundarySegments& region, const Cutter& cutter,
                                  BoundaryCut& cut, BoundarySegments& outside) {
  return region.count <= 8 ? cut_vectors<true>(region, cutter, cut, outside)
                           : cut_vectors<false>(region, cutter, cut, outside);
}

/// All lanes, as an explicit mask: GCC 12 warns about the intrinsics without one.
constexpr __mmask8 each = 0xff;

/// For a, then for b: the maximum of the first and second quarter, and of the third and fourth. A
/// quarter has two lanes.
TRANSILLUM_AVX512 inline __m512d larger_quarters(__m512d a, __m512d b) {
  return _mm512_maskz_max_pd(each, _mm512_maskz_shuffle_f64x2(each, a, b, 0x88),
                             _mm512_maskz_shuffle_f64x2(each, a, b, 0xdd));
}

TRANSILLUM_AVX512 Extent extent_avx512(const BoundarySegments& region) {
  const __m512d zero = _mm512_setzero_pd();
  __m512d most[8];
  for (__m512d& m : most) {
    m = _mm512_set1_pd(-HUGE_VAL);
  }
  for (std::size_t g = 0; g < region.count; g += 8) {
    const __mmask8 all = filled(region.count, g);
    const __m512d x = _mm512_load_pd(&region.ax[g]), y = _mm512_load_pd(&region.ay[g]);
    const __m512d along[4] = {x, y, _mm512_add_pd(x, y), _mm512_sub_pd(x, y)};
    for (std::size_t d = 0; d < 4; ++d) {
      most[d] = _mm512_mask_max_pd(most[d], all, most[d], along[d]);
      most[d + 4] =
          _mm512_mask_max_pd(most[d + 4], all, most[d + 4], _mm512_sub_pd(zero, along[d]));
    }
  }
  // Reduces pairs of vectors to one with half the lanes of each, until eight vectors are one.
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

SimdBackend avx512_backend() { return {"AVX-512", set_avx512, cut_avx512, extent_avx512}; }

}  // namespace transillum
#endif
