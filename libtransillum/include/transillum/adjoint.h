// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// Options of solve_adjoint().
struct AdjointOptions {
  /// Stop when no value changes by more than this times the largest one that is due to light on
  /// its way.
  double tolerance = 1e-6;
  /// Index into the materials given for each patch; if empty, Patch::material applies.
  std::span<const std::int32_t> patch_materials = {};
  int threads = 0;  ///< 0 uses all cores; the result does not depend on it
};

/// The effect of the light emitted by each patch on one patch.
struct Adjoint {
  /// dB_i / dPhi_j: by how much the radiosity of the receiver i rises with the power that patch j
  /// emits, 1/m², one per patch j. So patch j contributes `per_watt[j]` A_j E_j to B_i, and the
  /// contributions of all patches sum to B_i. A sky adds the contributions of its reflected light:
  /// `per_watt[j]` A_j rho_j H_j,sky.
  std::vector<Rgb> per_watt;
  int iterations = 0;  ///< applications of the transposed matrix
};

/// Solves the adjoint of B_i = E_i + rho_i sum_j F_ij B_j (eq. 8) for one patch: one solve with the
/// transposed matrix gives the influence of every patch on it, instead of one solve for each patch
/// (ALGORITHM.md, section 6.7).
///
/// Exact for the form factors given: equal to the differences of solves with and without the
/// emission, up to the tolerance. Light of a first shot counts as if it used these form factors.
/// @param scene the scene.
/// @param form_factors of `scene`, from RadiositySolver::form_factors().
/// @param receiver i.
/// @param materials as many as the scene has, in the same order; with
/// AdjointOptions::patch_materials any number. Only rho is used.
/// @param options tolerance, materials of patches, threads.
/// @param cancellation checked in each row.
/// @throws InputError where a list or the receiver does not fit the scene
/// @throws Canceled; NotConvergent where the row sums of the form factors are too large
Adjoint solve_adjoint(const Scene& scene, const FormFactors& form_factors, PatchId receiver,
                      const std::vector<Material>& materials, const AdjointOptions& options = {},
                      const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
