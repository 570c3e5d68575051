// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>

#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace transillum {

/// The result of drop_small_form_factors().
struct DroppedFormFactors {
  FormFactors form_factors;  ///< the remaining form factors, rebalanced
  std::size_t dropped = 0;   ///< number of omitted entries
  /// Sum of A_i F_ij over the dropped entries, over the sum of all: the fraction of light that was
  /// moved to other pairs.
  double fraction = 0;
  /// Number of entries below the threshold that are kept, without which their rows cannot be
  /// balanced.
  std::size_t kept = 0;
  double row_error = 0;  ///< largest relative difference of a row's sum from what it was
};

/// Omits tiny form factors and scales the others so that every row sums to what it summed to
/// before.
///
/// If A_i F_ij = A_j F_ji (to 1e-9), rows and columns are scaled alike, F_ij -> d_i d_j F_ij, so
/// that this still holds; a pair is omitted if both of its form factors are below the threshold.
/// Else each row is scaled by itself. Where a row cannot be balanced, because too few of its
/// entries are left, all of them are kept, and with them those of the same pairs; other rows lose
/// theirs.
/// @param scene the scene.
/// @param form_factors of `scene`.
/// @param threshold form factors below it are tiny; 0 < threshold < 1.
/// @param cancellation checked between sweeps over the matrix.
/// @throws InputError, Canceled
DroppedFormFactors drop_small_form_factors(const Scene& scene, const FormFactors& form_factors,
                                           double threshold, const Cancellation& cancellation = {});

}  // namespace transillum
