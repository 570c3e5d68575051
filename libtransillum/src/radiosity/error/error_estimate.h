// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "radiosity/error/surface_errors.h"
#include "radiosity/error/surfaces.h"
#include "transillum/first_shot.h"
#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// The surfaces whose errors are reported.
struct ErrorSurfaces {
  Surfaces reflecting;           ///< for errors of B - E
  Surfaces receiving;            ///< for errors of H
  std::vector<Rgb> reflectance;  ///< by patch: (B - E) / H

  ErrorSurfaces() = default;
  /// @param kept as in find_surfaces()
  /// @param lobes whether the lobes of materials reflect too
  ErrorSurfaces(const Scene& scene, const std::vector<std::string>& kept, bool lobes = false);
};

/// The error of `b` from the spread of replicas. Lists are of unknowns: with a linear basis, the
/// standard errors apply to the means of patches, and RMS errors to the functions. Errors of
/// H are not estimated.
/// @param replicas B of each, at least two
ErrorEstimate estimate_error(const Scene& scene, const ErrorSurfaces& surfaces,
                             const std::vector<Rgb>& b,
                             const std::vector<std::vector<Rgb>>& replicas);

/// Adds to an estimate what else `b` may be off by, as the root of the sum of squares: intervals
/// then contain the true value at least as often. Nothing without an estimate.
/// @param bias bound of a bias of `b`, W/m², one per patch or unknown; empty if there is none
void include_bias(ErrorEstimate& error, const Scene& scene, const ErrorSurfaces& surfaces,
                  const std::vector<Rgb>& b, const std::vector<Rgb>& bias);

/// Bound of what further iterations would change, W/m², one per patch: its reflectance times the
/// most that any patch can receive. Empty without iterations.
std::vector<Rgb> bias_of_iteration(const ErrorSurfaces& surfaces,
                                   const SolveStatistics& statistics);

/// Estimate of what B is off by because of the error of the first shot, W/m², one per unknown;
/// empty if there is none or it is unknown.
std::vector<Rgb> bias_of_shot(const Scene& scene, const ErrorSurfaces& surfaces,
                              const DirectLight& shot);

}  // namespace transillum
