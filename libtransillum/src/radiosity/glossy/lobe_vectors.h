// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>

#include "transillum/vec3.h"

namespace transillum {

// The inner loops of lobes, four doubles at a time, with AVX2 where the processor has it: the same
// bits everywhere, because products and sums are rounded in the same order.

/// A row of a kernel: p of the direction `a` with all directions of a hemisphere.
struct LobeRow {
  const double *x, *y, *z, *cosines;  ///< arrays over the directions
  std::size_t count;
  Vec3 a;
  double cosine;  ///< cosine of `a`
  double* values;
};

/// Sets the first values of a row to max(mirror, 0)^exponent, a mirror cosine of at most `least`
/// being taken as 0. Returns how many: all but the last few.
std::size_t phong_row(const LobeRow& row, double least, unsigned exponent);
/// The same for GGX.
std::size_t ggx_row(const LobeRow& row, double alpha2);

/// result[r · planes + k] = sum_q rows[r · count + q] vectors[k · count + q], for r < row_count.
/// Each product has four partial sums.
/// @param planes 1 or 3
void multiply_rows(const double* rows, std::size_t row_count, const double* vectors,
                   std::size_t planes, std::size_t count, double* result);

}  // namespace transillum
