// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The inner loops of lobes, in terms of vectors of four doubles: one source for all instruction
// sets. `blocks` and `rows` are as many as the registers of a set hold.
//
// Notation: q a direction; r a row; k a plane of the vectors.
#include "radiosity/glossy/lobe_vectors.h"

#include <cstring>

namespace transillum {
namespace {

using Four [[gnu::vector_size(4 * sizeof(double))]] = double;
constexpr std::size_t lanes = 4;

#define TRANSILLUM_INLINE [[gnu::always_inline]] inline

// By reference: how vectors are passed by value depends on the instruction set.
TRANSILLUM_INLINE void load(const double* from, Four& to) { std::memcpy(&to, from, sizeof to); }
TRANSILLUM_INLINE void store(const Four& from, double* to) { std::memcpy(to, &from, sizeof from); }

/// Cosines between `a` and the four directions from q.
TRANSILLUM_INLINE void find_between(const LobeRow& row, std::size_t q, Four& between) {
  Four x, y, z;
  load(row.x + q, x);
  load(row.y + q, y);
  load(row.z + q, z);
  between = row.a.x * x + row.a.y * y + row.a.z * z;
}

template <std::size_t blocks>
TRANSILLUM_INLINE std::size_t phong(const LobeRow& row, double least, unsigned exponent) {
  const Four none{}, one = none + 1.0, limit = none + least;
  std::size_t q = 0;
  for (; q + blocks * lanes <= row.count; q += blocks * lanes) {
    Four base[blocks], value[blocks];
#pragma GCC unroll 4
    for (std::size_t b = 0; b < blocks; ++b) {
      Four between, c;
      find_between(row, q + b * lanes, between);
      load(row.cosines + q + b * lanes, c);
      const Four mirror = 2 * (row.cosine * c) - between;
      base[b] = mirror > limit ? mirror : none;
      value[b] = one;
    }
    for (unsigned e = exponent; e > 0; e >>= 1) {
      if ((e & 1) != 0) {
#pragma GCC unroll 4
        for (std::size_t b = 0; b < blocks; ++b) {
          value[b] *= base[b];
        }
      }
#pragma GCC unroll 4
      for (std::size_t b = 0; b < blocks; ++b) {
        base[b] *= base[b];
      }
    }
#pragma GCC unroll 4
    for (std::size_t b = 0; b < blocks; ++b) {
      store(value[b], row.values + q + b * lanes);
    }
  }
  return q;
}

/// The same as ggx() in lobe_kernel.cpp.
TRANSILLUM_INLINE std::size_t ggx_values(const LobeRow& row, double alpha2) {
  const Four least = Four{} + 1e-30;
  std::size_t q = 0;
  for (; q + lanes <= row.count; q += lanes) {
    Four between, c;
    find_between(row, q, between);
    load(row.cosines + q, c);
    const Four sum = row.cosine + c, square = sum * sum, two = 2 + 2 * between;
    const Four length2 = two < least ? least : two;
    const Four smaller = length2 < square ? length2 : square;
    const Four ratio = alpha2 * length2 / (length2 + (alpha2 - 1) * smaller);
    store(ratio * ratio, row.values + q);
  }
  return q;
}

template <std::size_t rows, std::size_t planes>
TRANSILLUM_INLINE void multiply(const double* row, const double* vectors, std::size_t count,
                                double* result) {
  Four sums[rows][planes] = {};
  std::size_t q = 0;
  for (; q + lanes <= count; q += lanes) {
    Four light[planes];
#pragma GCC unroll 3
    for (std::size_t k = 0; k < planes; ++k) {
      load(vectors + k * count + q, light[k]);
    }
#pragma GCC unroll 4
    for (std::size_t r = 0; r < rows; ++r) {
      Four value;
      load(row + r * count + q, value);
#pragma GCC unroll 3
      for (std::size_t k = 0; k < planes; ++k) {
        sums[r][k] += value * light[k];
      }
    }
  }
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t k = 0; k < planes; ++k) {
      double partial[lanes];
      store(sums[r][k], partial);
      for (std::size_t rest = q; rest < count; ++rest) {
        partial[0] += row[r * count + rest] * vectors[k * count + rest];
      }
      result[r * planes + k] = (partial[0] + partial[1]) + (partial[2] + partial[3]);
    }
  }
}

template <std::size_t block, std::size_t planes>
TRANSILLUM_INLINE void multiply_all(const double* rows, std::size_t row_count,
                                    const double* vectors, std::size_t count, double* result) {
  std::size_t r = 0;
  for (; r + block <= row_count; r += block) {
    multiply<block, planes>(rows + r * count, vectors, count, result + r * planes);
  }
  for (; r < row_count; ++r) {
    multiply<1, planes>(rows + r * count, vectors, count, result + r * planes);
  }
}

#if defined(__x86_64__)
#define TRANSILLUM_AVX2 [[gnu::target("avx2")]]
bool has_avx2() {
  static const bool found = __builtin_cpu_supports("avx2") != 0;
  return found;
}

TRANSILLUM_AVX2 std::size_t phong_avx2(const LobeRow& row, double least, unsigned exponent) {
  return phong<4>(row, least, exponent);
}
TRANSILLUM_AVX2 std::size_t ggx_avx2(const LobeRow& row, double alpha2) {
  return ggx_values(row, alpha2);
}
TRANSILLUM_AVX2 void multiply_avx2(const double* rows, std::size_t row_count, const double* vectors,
                                   std::size_t planes, std::size_t count, double* result) {
  planes == 1 ? multiply_all<4, 1>(rows, row_count, vectors, count, result)
              : multiply_all<4, 3>(rows, row_count, vectors, count, result);
}
#endif

}  // namespace

std::size_t phong_row(const LobeRow& row, double least, unsigned exponent) {
#if defined(__x86_64__)
  if (has_avx2()) {
    return phong_avx2(row, least, exponent);
  }
#endif
  return phong<2>(row, least, exponent);
}

std::size_t ggx_row(const LobeRow& row, double alpha2) {
#if defined(__x86_64__)
  if (has_avx2()) {
    return ggx_avx2(row, alpha2);
  }
#endif
  return ggx_values(row, alpha2);
}

void multiply_rows(const double* rows, std::size_t row_count, const double* vectors,
                   std::size_t planes, std::size_t count, double* result) {
#if defined(__x86_64__)
  if (has_avx2()) {
    multiply_avx2(rows, row_count, vectors, planes, count, result);
    return;
  }
#endif
  planes == 1 ? multiply_all<4, 1>(rows, row_count, vectors, count, result)
              : multiply_all<2, 3>(rows, row_count, vectors, count, result);
}

}  // namespace transillum
