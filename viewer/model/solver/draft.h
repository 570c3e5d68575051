// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A whole picture before the solve that was asked for: few passes and all iterations.
#pragma once

#include <functional>
#include <optional>

#include "model/snapshot.h"
#include "transillum/cancellation.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

/// A finished solve with the same functions on patches as `session`, but few directions.
/// @param session  prepared, of which no pass has been made
/// @param continues  false ends the draft
/// @returns nothing where a draft would take a large part of the solve's time, or long, or was
/// ended
/// @throws Canceled
std::optional<Solution> make_draft(const SolveSession& session,
                                   const std::function<bool()>& continues,
                                   const Cancellation& cancellation);

/// Replaces the light of a snapshot by the light of another solve of the same patches. The progress
/// of its own solve stays.
void show_light_of(const Solution& solution, SolverSnapshot& snapshot);

}  // namespace transillum::viewer
