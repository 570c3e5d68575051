// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A whole picture before the solve that was asked for: few passes and all iterations.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "model/snapshot.h"
#include "transillum/cancellation.h"
#include "transillum/first_shot.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

/// Whether a draft of a solve takes a small part of the solve's time, and is not long.
/// @param options of the solve
/// @param scene   what is solved
bool can_be_drafted(const SolveOptions& options, const Scene& scene);

/// A solve of few directions, prepared and not finished. Linear functions would take most of its
/// time: the functions are constant. Lobes reflect diffusely.
/// @param options  of the solve
/// @param loaded   what is solved, and its tree
/// @param shot     the direct light of the solve's first shot; null for one of few points, where it
///                 pays
/// @throws InputError where some options need many directions; Canceled
SolveSession prepare_draft(SolveOptions options, const LoadedScene& loaded,
                           std::shared_ptr<const DirectLight> shot,
                           const Cancellation& cancellation);

/// Patches of larger scenes are too small to be seen.
inline constexpr PatchId most_fitted_patches = 20'000;
/// Linear functions to look at, with the means of these constant ones.
FittedLight fitted_light(const SolvedLight& light, const Scene& scene);
/// Light to look at: constant functions become fitted_light(), linear ones stay.
Solution smoothed(Solution light);

/// Whether a finished stage is nearer to the result than a draft is. A stage has several replicas
/// of few directions each, and their mean is less accurate than one set of as many directions.
bool is_better_than_draft(const SolveStatistics& statistics);

/// Replaces the light of a snapshot by the light of another solve of the same patches. The progress
/// of its own solve stays.
void show_light_of(const Solution& solution, SolverSnapshot& snapshot);

}  // namespace transillum::viewer
