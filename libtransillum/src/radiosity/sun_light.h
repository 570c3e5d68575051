// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/linear_basis.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum {

/// The light of the sun on each patch, by exact passes, whatever the engine of the solve.
struct SunLight {
  std::vector<Rgb> irradiance;           ///< W/m², one per patch; empty without a sun
  std::vector<LinearTerm> linear_terms;  ///< linear parts; empty with Basis::constant
};

/// A direction, and how much of the sun's irradiance comes along it.
struct SunRay {
  Vec3 direction;     ///< unit, toward the sun
  double weight = 1;  ///< weights by the cosine to Sun::direction sum to 1
};
/// The directions of a sun: one, or those over its disc.
std::vector<SunRay> rays_of(const Sun& sun);

/// Computes the light of `options.sky.sun`; nothing without one.
/// @param tree of the scene; made where null.
/// @param engine of the solve, used if it is `fast`; made where null.
/// @throws Canceled
SunLight sun_light(const std::shared_ptr<const Scene>& scene,
                   const std::shared_ptr<const BspTree>& tree, const SolveOptions& options,
                   const Cancellation& cancellation, TransferEngine engine = {});

}  // namespace transillum
