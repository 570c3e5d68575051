// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "solve_call.h"
#include "transillum/cancellation.h"
#include "transillum/refinement.h"

namespace transillum::cli {

/// Divides the faces of a scene in the rounds of --refine-by, and prints each.
/// @throws InputError, Canceled, SolveError
Refinement refine_in_rounds(const SolveCall& call, const std::shared_ptr<const Scene>& scene,
                            const SolveOptions& options, const Cancellation& cancellation);

}  // namespace transillum::cli
