// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"

namespace transillum {

/// Options of find_light_paths().
struct LightPathOptions {
  int count = 100;  ///< most paths to return, 1 … 1,000,000
  double smallest_fraction =
      1e-6;                 ///< fraction of B, by luminance, below which paths are cut off; > 0
  double tolerance = 1e-9;  ///< tolerance of B, as in RelightOptions
  /// Initial B for the solve, W/m², one per patch; E if empty.
  std::span<const Rgb> start = {};
  /// Index into the materials given for each patch; if empty, Patch::material applies.
  std::span<const std::int32_t> patch_materials = {};
  /// Irradiance of each patch from a sky, as for relight(): it counts as if the patches that it
  /// meets first emitted what they reflect of it, so such a path begins there. Empty without a sky.
  std::span<const Rgb> sky_irradiance = {};
  /// The part of sky_irradiance that the sun gives, as SunLight::irradiance: its paths are
  /// listed separately. Empty without a sun.
  std::span<const Rgb> sun_irradiance = {};
  int threads = 0;  ///< threads of the solve; 0 uses all cores; the result does not depend on it
};

/// Where a light path begins.
enum class LightOrigin {
  emission,  ///< with light that its first patch emits
  sky,       ///< with light of the sky that its first patch reflects
  sun,       ///< with light of the sun that its first patch reflects
};

/// Light that leaves a source and reaches a patch by way of others.
struct LightPath {
  std::vector<PatchId> patches;  ///< from the source to the receiver
  Rgb contribution;              ///< to B of the receiver, W/m²
  LightOrigin origin = LightOrigin::emission;

  /// Number of reflections, by the receiver included.
  std::size_t reflections() const {
    return patches.size() - (origin == LightOrigin::emission ? 1 : 0);
  }
};

/// The result of find_light_paths().
struct LightPaths {
  std::vector<LightPath> paths;  ///< the strongest first, by luminance
  Rgb radiosity;                 ///< B of the receiver by the form factors given, W/m²
  /// Sum of the contributions of all other paths, W/m²: B is the sum of `paths` and this.
  Rgb cut_off;
  bool complete = true;  ///< false: a stronger path may be missing; the search ran out of memory
};

/// The strongest paths by which light reaches a patch.
///
/// Best first: all paths that continue an unfinished one backward from patch k carry its product of
/// rho and F times B_k in total, which bounds each of them (ALGORITHM.md, section 6.7). So the
/// paths returned are the strongest, and the rest is known without being enumerated. Light of a
/// first shot counts as if it used these form factors.
/// @param scene the scene.
/// @param form_factors of `scene`, from RadiositySolver::form_factors().
/// @param receiver the patch that paths end at.
/// @param materials as for relight().
/// @param options number of paths, limits, materials of patches, threads.
/// @param cancellation checked between rows.
/// @throws InputError where a list, the receiver or an option is out of range
/// @throws Canceled; NotConvergent where the row sums of the form factors are too large
LightPaths find_light_paths(const Scene& scene, const FormFactors& form_factors, PatchId receiver,
                            const std::vector<Material>& materials,
                            const LightPathOptions& options = {},
                            const Cancellation& cancellation = {});

}  // namespace transillum
