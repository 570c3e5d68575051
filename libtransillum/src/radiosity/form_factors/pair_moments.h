// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

#include "radiosity/form_factors/counted_pairs.h"
#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/pair_form_factors.h"
#include "transillum/scene.h"

namespace transillum {

/// Number of unknowns of a patch with linear functions; unknown 3 i + a has the function phi_a.
constexpr std::size_t linear_unknowns = 3;

/// pair_form_factors() of unknowns: row 3 i + a has T^ab(i,j) / A_i at 3 j + b, T^ab being
/// ∫∫ phi_a(x) phi_b(y) cos cos / (pi r²) over what sees each other.
/// @throws InputError, Canceled, MemoryLimitExceeded
FormFactors pair_moment_factors(const Scene& scene, const PairOptions& options,
                                const Cancellation& cancellation,
                                const std::function<void(double)>& progress,
                                IntegratedPairs& integrated);
/// The form factors of constant functions, T^00 / A_i.
FormFactors factors_of_means(const FormFactors& of_unknowns);

}  // namespace transillum
