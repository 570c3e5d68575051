// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/first_shot.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace transillum {

struct RelightOptions {
  double tolerance =
      1e-6;  ///< stop where no patch changes by more than this share of the largest B
  /// B to start from, W/m², one a patch; empty: E. The nearer it is, the fewer steps.
  std::span<const Rgb> start = {};
  /// The first shot of the solve that the form factors are of (RadiositySolver::direct_light()),
  /// if it made one: its sources stay those that are shot.
  const DirectLight* shot = nullptr;
  int threads = 0;  ///< 0: all cores; the result does not depend on it
};

/// The light of a scene whose surfaces are others.
struct RelightResult {
  std::vector<Rgb> radiosity;   ///< B, W/m², one a patch
  std::vector<Rgb> irradiance;  ///< H, W/m², one a patch
  int iterations = 0;           ///< of eq. 11
};

/// B_i = E_i + rho_i sum_j F_ij B_j (eq. 11) with E and rho of other materials: form factors are of
/// the geometry alone, so those that a solve has kept serve again and no pass is made. Jacobi
/// iteration; a step takes time as there are form factors.
/// @param form_factors of `scene`, as RadiositySolver::form_factors() gives them. Those of the
/// semi-iterative scheme are of the directions of all its steps, and B is what a solve with all of
/// them at once gives, where the scheme's own is a mean over steps: both approach the same.
/// @param materials as many as the scene has, in its order.
/// @throws InputError where a material's E or rho is out of range, lists are of wrong lengths, or
/// the shot's parts have been left out
/// @throws Canceled, std::runtime_error where 10,000 steps do not get there
RelightResult relight(const Scene& scene, const FormFactors& form_factors,
                      const std::vector<Material>& materials, const RelightOptions& options = {},
                      const Cancellation& cancellation = {});

}  // namespace transillum
