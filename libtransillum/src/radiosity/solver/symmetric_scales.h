// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "transillum/transfers.h"

namespace transillum {

// The symmetric normalization (ALGORITHM.md 6.1, 6.12) scales the exchange of patches i and j,
// S_ij -> D_i S_ij D_j, D_i being the number d_0 with constant functions. With linear functions
// S_ij is the block of T^ab, and D_i a symmetric matrix: multiplication by the function
// d_0 + d_1 phi_1 + d_2 phi_2,
//   d_0 d_1 d_2
//   d_1 d_0  0
//   d_2  0  d_0
// Scales are d_a as unknown n i + a, n being the unknowns of a patch.

/// D times `values`.
template <class Value>
std::vector<Value> scaled(const std::vector<double>& scales, const std::vector<Value>& values,
                          std::size_t per_patch) {
  std::vector<Value> products(values.size());
  for (std::size_t u = 0; u < values.size(); u += per_patch) {
    products[u] = scales[u] * values[u];
    for (std::size_t k = u + 1; k < u + per_patch; ++k) {
      products[u] += scales[k] * values[k];
      products[k] = scales[k] * values[u] + scales[u] * values[k];
    }
  }
  return products;
}

/// D_i T D_j of linear functions.
/// @param scales_i, scales_j three numbers
TransferMoments scaled(const TransferMoments& moments, std::span<const double> scales_i,
                       std::span<const double> scales_j);

/// One sweep for one patch: changes its scales toward D image = wanted, where that can be had.
/// Rows whose light is far from even get a number only, for the row's sum.
/// @param scales 1 or 3 numbers; the others are as long
/// @param wanted, image rows of sums over the sources' phi_0; `image` with scaled sources
/// @returns the largest relative difference of what was wanted before
double improve_scales(std::span<double> scales, std::span<const double> wanted,
                      std::span<const double> image);

}  // namespace transillum
