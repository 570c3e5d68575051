// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/pair_form_factors.h"
#include "transillum/scene.h"

namespace transillum {

/// SolveStatistics::integrated_pairs. Any thread may count.
using IntegratedPairs = std::atomic<std::int64_t>;

/// pair_form_factors() that count pairs.
/// @throws InputError, Canceled, MemoryLimitExceeded
FormFactors pair_matrix(const Scene& scene, const PairOptions& options,
                        const Cancellation& cancellation,
                        const std::function<void(double)>& progress, IntegratedPairs& integrated);

}  // namespace transillum
