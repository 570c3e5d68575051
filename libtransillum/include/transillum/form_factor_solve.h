// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/hemicube.h"
#include "transillum/pair_form_factors.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace TRANSILLUM_API transillum {

/// Checks options for solve_by_form_factors().
/// The options of hemicube_form_factors() that a solve has.
HemicubeOptions hemicube_options(const SolveOptions& options);
/// The options of pair_form_factors() that a solve has.
PairOptions pair_options(const SolveOptions& options);

/// @throws InputError where solve_by_form_factors() would.
void check_form_factor_options(const SolveOptions& options);

/// Solves with an engine that has no directions, by hemicube_form_factors() or pair_form_factors()
/// and the iteration of solve(), to the same tolerance or number of iterations.
///
/// In the statistics a row of form factors counts as a pass. For engine hemicube, a pixel of a
/// hemicube counts as a direction, `escaped` is the fraction of all pixels that show no front side,
/// and `energy_defect` the error in the energy balance due to the missing reciprocity. For engine
/// pairs, PairOptions::points is reported as the number of directions.
/// @param scene the scene.
/// @param options engine (hemicube or pairs), tolerance, iterations, engine_options.resolution or
/// points (0 means the default), memory and threads apply.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws InputError where an option requires directions
/// @throws Canceled, MemoryLimitExceeded, NotConvergent
Solution solve_by_form_factors(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                               const Cancellation& cancellation = {},
                               const std::function<void(double)>& progress = {});

/// Solves with given form factors, by the iteration of solve_by_form_factors(). No passes are made:
/// in the statistics, the numbers of passes and of directions are 0.
/// @param scene the scene.
/// @param form_factors of `scene`, as of read_form_factors().
/// @param options tolerance, iterations and threads apply.
/// @param cancellation checked during the iteration.
/// @throws InputError where the form factors are of another number of patches, or an option
/// requires directions
/// @throws Canceled, NotConvergent
Solution solve_with_form_factors(std::shared_ptr<const Scene> scene, FormFactors form_factors,
                                 const SolveOptions& options,
                                 const Cancellation& cancellation = {});

/// The result of solve_by_pairs().
struct PairSolution {
  Solution solution;     ///< result of the last solve
  int points = 0;        ///< PairOptions::points of the last solve
  double error = 0;      ///< estimated RadiosityError::rms; 0 where nothing is partly hidden
  bool reached = false;  ///< error <= accuracy
};

/// Solves with pair_form_factors() to an accuracy of B: doubles the number of points until B
/// changes by at most `accuracy`, which is then a cautious estimate of the remaining error. Stops
/// at EngineOptions::largest_points.
/// @param scene the scene.
/// @param options as for solve_by_form_factors() with engine pairs; engine_options.points is the
/// number to start from (0: an eighth of the default). The tolerance is lowered to a tenth of
/// `accuracy` if it is above that.
/// @param accuracy RMS error of B over RMS of reflected light, between 0 and 1.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the number of points of the solve under way and
/// its fraction done, in [0,1], on this thread.
/// @throws InputError, Canceled, MemoryLimitExceeded, NotConvergent
PairSolution solve_by_pairs(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                            double accuracy, const Cancellation& cancellation = {},
                            const std::function<void(int points, double fraction)>& progress = {});

}  // namespace TRANSILLUM_API transillum
