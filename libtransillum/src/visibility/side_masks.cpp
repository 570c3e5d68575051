// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loop of the fast engine, in the widest vectors that the processor has. All ways give
// the same bits: they round the same products and sums, and nothing is fused.
#include "visibility/side_masks.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace transillum {
namespace {

template <class Real>
std::size_t find_sides_one_by_one(const Real* x, const Real* y, std::size_t corner_count,
                                  const DirectedLine<Real>* lines, const DirectedRef* refs,
                                  std::size_t line_count, Real error, Sides* sides) {
  const std::uint64_t all = (std::uint64_t{1} << corner_count) - 1;
  for (std::size_t k = 0; k < line_count; ++k) {
    const DirectedLine<Real>& line = lines[static_cast<std::size_t>(refs[k] >> 1)];
    const Real limit = line.length * (line.slack + error);
    Sides found;
    for (std::size_t g = 0; g < corner_count; ++g) {
      const Real side = line.dx * y[g] - line.dy * x[g] + line.c;
      found.left |= static_cast<std::uint64_t>(side > limit) << g;
      found.right |= static_cast<std::uint64_t>(side < -limit) << g;
    }
    if (refs[k] & 1) found = {found.right, found.left};
    sides[k] = found;
    if (found.right == all) return k;
  }
  return line_count;
}

#if defined(__x86_64__)
__attribute__((target("avx512f"))) std::size_t find_sides_by_eight(
    const double* x, const double* y, std::size_t corner_count, const DirectedLine<double>* lines,
    const DirectedRef* refs, std::size_t line_count, double error, Sides* sides) {
  const std::uint64_t all = (std::uint64_t{1} << corner_count) - 1;
  for (std::size_t k = 0; k < line_count; ++k) {
    const DirectedLine<double>& line = lines[static_cast<std::size_t>(refs[k] >> 1)];
    const double limit = line.length * (line.slack + error);
    const __m512d dx = _mm512_set1_pd(line.dx), dy = _mm512_set1_pd(line.dy);
    const __m512d c = _mm512_set1_pd(line.c);
    const __m512d high = _mm512_set1_pd(limit), low = _mm512_set1_pd(-limit);
    Sides found;
    for (std::size_t g = 0; g < corner_count; g += 8) {
      const __m512d side = _mm512_add_pd(_mm512_sub_pd(_mm512_mul_pd(dx, _mm512_load_pd(y + g)),
                                                       _mm512_mul_pd(dy, _mm512_load_pd(x + g))),
                                         c);
      found.left |= static_cast<std::uint64_t>(_mm512_cmp_pd_mask(side, high, _CMP_GT_OQ)) << g;
      found.right |= static_cast<std::uint64_t>(_mm512_cmp_pd_mask(side, low, _CMP_LT_OQ)) << g;
    }
    if (refs[k] & 1) found = {found.right, found.left};
    sides[k] = {found.left & all, found.right & all};
    if (sides[k].right == all) return k;
  }
  return line_count;
}

__attribute__((target("avx2"))) std::size_t find_sides_by_four(
    const double* x, const double* y, std::size_t corner_count, const DirectedLine<double>* lines,
    const DirectedRef* refs, std::size_t line_count, double error, Sides* sides) {
  const std::uint64_t all = (std::uint64_t{1} << corner_count) - 1;
  for (std::size_t k = 0; k < line_count; ++k) {
    const DirectedLine<double>& line = lines[static_cast<std::size_t>(refs[k] >> 1)];
    const double limit = line.length * (line.slack + error);
    const __m256d dx = _mm256_set1_pd(line.dx), dy = _mm256_set1_pd(line.dy);
    const __m256d c = _mm256_set1_pd(line.c);
    const __m256d high = _mm256_set1_pd(limit), low = _mm256_set1_pd(-limit);
    Sides found;
    for (std::size_t g = 0; g < corner_count; g += 4) {
      const __m256d side = _mm256_add_pd(_mm256_sub_pd(_mm256_mul_pd(dx, _mm256_load_pd(y + g)),
                                                       _mm256_mul_pd(dy, _mm256_load_pd(x + g))),
                                         c);
      found.left |= static_cast<std::uint64_t>(static_cast<unsigned>(
                        _mm256_movemask_pd(_mm256_cmp_pd(side, high, _CMP_GT_OQ))))
                    << g;
      found.right |= static_cast<std::uint64_t>(static_cast<unsigned>(
                         _mm256_movemask_pd(_mm256_cmp_pd(side, low, _CMP_LT_OQ))))
                     << g;
    }
    if (refs[k] & 1) found = {found.right, found.left};
    sides[k] = {found.left & all, found.right & all};
    if (sides[k].right == all) return k;
  }
  return line_count;
}
#endif

}  // namespace

template <>
std::size_t find_sides(const long double* x, const long double* y, std::size_t corner_count,
                       const DirectedLine<long double>* lines, const DirectedRef* refs,
                       std::size_t line_count, long double error, Sides* sides) {
  return find_sides_one_by_one(x, y, corner_count, lines, refs, line_count, error, sides);
}

template <>
std::size_t find_sides(const double* x, const double* y, std::size_t corner_count,
                       const DirectedLine<double>* lines, const DirectedRef* refs,
                       std::size_t line_count, double error, Sides* sides) {
  static const auto widest = find_sides_ways().front().find;
  return widest(x, y, corner_count, lines, refs, line_count, error, sides);
}

std::vector<FindSidesWay> find_sides_ways() {
  std::vector<FindSidesWay> ways;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) ways.push_back({"by eight", find_sides_by_eight});
  if (__builtin_cpu_supports("avx2")) ways.push_back({"by four", find_sides_by_four});
#endif
  ways.push_back({"one by one", find_sides_one_by_one<double>});
  return ways;
}

}  // namespace transillum
