// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/first_shot.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"
#include "transillum/solution.h"

namespace TRANSILLUM_API transillum {

/// Options of relight().
struct RelightOptions {
  double tolerance = 1e-6;  ///< see SolveOptions::tolerance
  /// Initial B, W/m², one per patch; E if empty. The closer to the result, the fewer iterations.
  std::span<const Rgb> start = {};
  /// Linear parts of `start`; 0 if empty.
  std::span<const LinearTerm> start_linear_terms = {};
  /// The first shot of the solve run that the form factors come from
  /// (RadiositySolver::direct_light()), if it made one: the same sources are shot again.
  const DirectLight* shot = nullptr;
  /// Index into the materials given for each patch, so that the faces of one material may have
  /// different ones, as change_materials() makes them; if empty, Patch::material applies.
  std::span<const std::int32_t> patch_materials = {};
  /// Irradiance of each patch from a sky and sun, W/m², one per patch (Solution::sky_irradiance):
  /// it depends on the geometry only. Empty if there is no sky.
  std::span<const Rgb> sky_irradiance = {};
  /// Solution::sky_linear_terms, with Basis::linear.
  std::span<const LinearTerm> sky_linear_terms = {};
  /// linear: functions on patches, from FormFactors::moments.
  Basis basis = Basis::constant;
  int threads = 0;  ///< 0 uses all cores; the result does not depend on it
};

/// The result of relight().
struct RelightResult {
  std::vector<Rgb> radiosity;   ///< B, W/m², one per patch
  std::vector<Rgb> irradiance;  ///< H, W/m², one per patch
  int iterations = 0;           ///< iterations of eq. 11
  /// One per iteration, as of a solve where RelightOptions::start is empty.
  std::vector<IterationRecord> iteration_records = {};
  /// Linear parts of B, W/m², one per patch; empty with Basis::constant.
  std::vector<LinearTerm> linear_terms = {};
};

/// Solves B_i = E_i + rho_i sum_j F_ij B_j (eq. 11) with E and rho of other materials. Form factors
/// depend on the geometry only, so those kept by a solve run are reused and no pass is made. Jacobi
/// iteration; the time of an iteration is proportional to the number of form factors.
/// @param scene the scene.
/// @param form_factors of `scene`, from RadiositySolver::form_factors(). Form factors of the
/// semi-iterative scheme average the directions of all its iterations: the result is B for all
/// these directions at once, while the scheme's own B is a mean over iterations; both have the same
/// limit.
/// @param materials as many as the scene has, in the same order; with
/// RelightOptions::patch_materials any number.
/// @param options tolerance, initial B, first shot, materials of patches and threads.
/// @param cancellation checked between iterations.
/// @throws InputError where a material's E or rho is out of range, a list has the wrong length, or
/// the shot has no parts, or sources of one material in the shot now differ in E, or functions are
/// linear and the form factors or the shot were made for constant ones
/// @throws Canceled; std::runtime_error after 10,000 iterations
RelightResult relight(const Scene& scene, const FormFactors& form_factors,
                      const std::vector<Material>& materials, const RelightOptions& options = {},
                      const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
