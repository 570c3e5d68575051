// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "scene/build/division.h"
#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// The errors of the functions of patches, found by a solve with divided patches. Integrals over
/// each patch of the whole scene of squares of W/m², by channel: W²/m².
struct PatchErrors {
  /// The part of the radiosity that the functions of the patch cannot represent.
  std::vector<Rgb> unrepresented;
  /// Difference between what they can represent and what the solve with whole patches has found:
  /// patches that send light are too coarse. Empty without such a solve.
  std::vector<Rgb> displaced;
};

/// Compares a solve with divided patches with one with whole patches.
/// @param divided of `whole`
/// @param fine the solve of `divided`
/// @param coarse the solve of `whole`, of the same directions and basis; null if there is none
PatchErrors patch_errors(const Scene& whole, const DividedScene& divided, const Solution& fine,
                         const Solution* coarse = nullptr);

/// Integral of B² over patch i.
Rgb square_integral(const Solution& solution, PatchId i);

}  // namespace transillum
