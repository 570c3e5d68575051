// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum {

/// One row of the matrix of form factors, and the light of the sun on its patch.
struct ReceiverRow {
  std::vector<PatchId> source;  ///< j, ascending
  std::vector<double> value;    ///< F_ij
  /// T^01(i,j) / A_i and T^02(i,j) / A_i beside `value`; empty with constant functions.
  std::vector<std::array<double, 2>> moments = {};
  Rgb sun = {};  ///< irradiance of the patch from the sun, W/m²
};

/// Row i of the form factors of a solve, without `sun`.
ReceiverRow row_of(const FormFactors& form_factors, PatchId i);

/// Irradiance of patch i from the sun of `options`, W/m²: SunLight::irradiance of one patch.
/// @throws Canceled
Rgb sun_on_patch(const std::shared_ptr<const Scene>& scene,
                 const std::shared_ptr<const BspTree>& tree, PatchId i, const SolveOptions& options,
                 const Cancellation& cancellation = {});

/// The row of one patch computed again from the directions of a solve, with its engine: up to
/// rounding the same as in RadiositySolver::form_factors(). Engine fast makes one visibility query
/// per direction, others a pass.
/// @param tree of the scene.
/// @param directions of the passes.
/// @param options of the solve; its normalization must not be symmetric, which needs all rows.
/// @param progress called with the fraction done, on this thread.
/// @throws std::invalid_argument where the normalization is symmetric
/// @throws InputError, Canceled
ReceiverRow receiver_row(const std::shared_ptr<const Scene>& scene,
                         const std::shared_ptr<const BspTree>& tree, PatchId i,
                         std::span<const Vec3> directions, const SolveOptions& options,
                         const Cancellation& cancellation = {},
                         const std::function<void(double)>& progress = {});

}  // namespace transillum
