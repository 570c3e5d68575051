// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// How much two results differ on one surface. Relative differences are relative to `unit`.
struct SurfaceDifference {
  std::string name;          ///< group, material or component (SurfaceError::name)
  std::int64_t patches = 0;  ///< number of patches that are compared
  double level = 0;          ///< RMS of the reflected light of the first result, W/m²
  Rgb unit;                  ///< SurfaceError::unit of its reflected light
  bool is_dark = false;      ///< SurfaceError::is_dark
  /// RMS of the differences of B over patches, relative, of the channel that differs the most; 0
  /// where nothing differs, infinite where only the first result is dark everywhere
  double rms = 0;
  double largest = 0;        ///< largest |difference| of a channel, relative
  PatchId worst = no_patch;  ///< the patch with the largest difference; no_patch: nothing differs
  Rgb first = {};            ///< its B in the first result, W/m²
  Rgb second = {};           ///< its B in the second result, W/m²
};

/// How two results of one scene differ. Patches that emit in either, or reflect nothing, are
/// omitted, unless all do.
struct ResultComparison {
  std::vector<SurfaceDifference> surfaces;  ///< the largest RMS first; not empty
  /// RMS of all differences over the RMS of all reflected light of the first result, of the channel
  /// that differs the most
  double rms = 0;
  /// By patch: `unit` of its surface, W/m²; 0 for patches that are omitted.
  std::vector<Rgb> units;
  std::string sky_difference = {};  ///< transillum::sky_difference()
};

/// The part of a result that is compared, W/m², one per patch.
struct PatchLight {
  std::vector<Rgb> exitance;   ///< E
  std::vector<Rgb> radiosity;  ///< B
};

/// The first difference of two scenes in number, corners, E or rho of their patches, as "patch 3
/// has rho 0.5 0.5 0.5 in one and 0.7 0.7 0.7 in the other"; empty where they are the same, bit for
/// bit. Names, materials and groups may differ.
std::string scene_difference(const Scene& one, const Scene& other);

/// The difference of patch i of one scene and patch j of another in E or rho, as "E 1 1 1 in one
/// and 2 2 2 in the other"; empty where both are the same.
std::string material_difference(const Scene& one, PatchId i, const Scene& other, PatchId j);

/// How the skies of two solves differ, as "one has a sky of 1 1 1 W/m2, uniform, and the other has
/// none"; empty where they are the same. A result of unknown sky (from a file of an older version)
/// is the same as any other.
std::string sky_difference(const Solution& one, const Solution& other);

/// Compares the B of two results for the patches of one scene, whose materials may differ.
/// @param scene gives the surfaces; its materials, which patches reflect.
/// @param first what differences are relative to.
/// @param second the other one.
ResultComparison compare_light(const Scene& scene, const PatchLight& first,
                               const PatchLight& second);

/// Compares the B of two results of the same scene. Skies may differ.
/// @param first what differences are relative to.
/// @param second the other one.
/// @throws InputError with scene_difference() where the scenes differ.
ResultComparison compare_results(const Solution& first, const Solution& second);

}  // namespace transillum
