// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/engine.h"
#include "transillum/export.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace TRANSILLUM_API transillum {

/// Options of pair_form_factors().
struct PairOptions {
  /// Number of points along a patch as large as its distance from the other, where blockers hide
  /// part of the one from the other; 1 … EngineOptions::largest_points. Where a quarter of them
  /// finds too different a value, or points near corners do, more are taken where they matter.
  /// Other pairs need none.
  int points = EngineOptions::default_points;
  std::uint64_t memory = 0;  ///< limit for the form factors, bytes; 18 per nonzero entry while they
                             ///< are assembled, with moments 162; 0: a quarter of the machine's
  int threads = 0;           ///< 0 uses all cores; the result does not depend on it
  Basis basis = Basis::constant;  ///< linear: FormFactors::moments are computed too

  /// @throws InputError naming the option and its range.
  void validate() const;
};

/// Form factors of all pairs of patches, without directions, pixels or rays: a reference for the
/// others.
///
/// Each pair is computed once, as the rows by exact_form_factors(): in closed form where nothing is
/// between; otherwise from points of one patch, where the blockers hide parts of the other.
/// Thus A_i F_ij = A_j F_ji up to one rounding of each, in closed scenes rows sum to 1 up to the
/// distance of the points, and for pairs with nothing between exactly. Time grows as the square of
/// the number of patches, times the number of blockers between two.
/// @param scene the scene.
/// @param options points, memory and threads.
/// @param cancellation checked during computation, also within a pair.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws InputError, Canceled, MemoryLimitExceeded
FormFactors pair_form_factors(const Scene& scene, const PairOptions& options,
                              const Cancellation& cancellation = {},
                              const std::function<void(double)>& progress = {});

/// F_ij of one patch i to every patch j, without directions or pixels: a reference for engines.
///
/// Exact where nothing stands between two patches. Otherwise one of them is sampled at many
/// points, from each of which the other's visible part is computed exactly (first_shot.h). In a
/// closed scene the sum is 1 up to that sampling. Takes one computation per patch j; its cost for a
/// partly hidden pair grows with the number of polygons between them.
/// @param scene the scene.
/// @param i the patch.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the fraction done, in [0,1], on this thread.
/// @throws Canceled
std::vector<double> exact_form_factors(const Scene& scene, PatchId i,
                                       const Cancellation& cancellation = {},
                                       const std::function<void(double)>& progress = {});

}  // namespace TRANSILLUM_API transillum
