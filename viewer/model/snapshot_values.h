// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What is read off a snapshot: its solution, values at points, form factors of a patch.
#pragma once

#include <QString>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/snapshot.h"
#include "transillum/solution.h"
#include "transillum/visibility_map.h"

namespace transillum::viewer {

/// The solution that a snapshot shows, with the light of changed materials; its scene has the
/// materials from before the changes. Copies all values: for a worker where there are many patches.
/// @param complete  whether the solve has finished; ignored for a result file, which says so itself
Solution solution_of(const SolverSnapshot& snapshot, bool complete = true);

/// The value at a point of a linear function on a patch.
/// @param mean  over the patch
Rgb value_at(const Rgb& mean, const LinearTerm& term, const LinearBasis& basis, const Vec3& point);

/// B at a point of patch i, W/m², which may be below 0; the mean of the patch where B is constant
/// on patches.
Rgb radiosity_at(const SolverSnapshot& snapshot, PatchId i, const Vec3& point);

/// The options of a snapshot's run.
RunOptions run_options_of(const SolverSnapshot& snapshot, const SceneOptions& scene,
                          const SceneInput& input);

/// Whether any patch emits, with the materials of the snapshot, or a sky does.
bool has_light(const SolverSnapshot& snapshot);

/// The fraction of the light that escapes, with the materials of the snapshot, as escaped_share();
/// none before the first iteration, or where the fraction of sky is not known.
std::optional<double> escaped_share(const SolverSnapshot& snapshot);

/// SolveStatistics::negative_corners of the snapshot.
std::int64_t count_negative_corners(const SolverSnapshot& snapshot);

/// F_ij of patches i and j; 0 where neither sees the other.
double form_factor(const FormFactors& form_factors, PatchId i, PatchId j);
/// F_ij of patch i for all j, one per patch.
std::vector<double> form_factors_from(const FormFactors& form_factors, PatchId i);
/// F_ji for all j and patch i, one per patch.
std::vector<double> form_factors_to(const FormFactors& form_factors, PatchId i);

/// The reason, for the user, why a snapshot has no form factors.
QString why_no_form_factors(const SolverSnapshot& snapshot);

}  // namespace transillum::viewer
