// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/pair_form_factors.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum {

/// Number of unknowns of a patch with linear functions; unknown 3 i + a has the function phi_a.
constexpr std::size_t linear_unknowns = 3;

/// SolveStatistics::integrated_pairs. Any thread may count.
using IntegratedPairs = std::atomic<std::int64_t>;

/// pair_form_factors() of n unknowns a patch, constant or linear functions: row n i + a has
/// T^ab(i,j) / A_i at n j + b, T^ab being ∫∫ phi_a(x) phi_b(y) cos cos / (pi r²) over what sees
/// each other.
/// @throws InputError, Canceled, MemoryLimitExceeded
FormFactors pair_matrix(const Scene& scene, const PairOptions& options, Basis basis,
                        const Cancellation& cancellation,
                        const std::function<void(double)>& progress, IntegratedPairs& integrated);

}  // namespace transillum
