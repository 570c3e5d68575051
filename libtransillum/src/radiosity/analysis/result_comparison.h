// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/scene.h"
#include "transillum/solution.h"

namespace transillum {

/// The difference of B over some patches, without those that emit unless all do.
struct RadiosityDifference {
  /// RMS of the differences over the RMS of the reflected light of the first result, over channels
  /// and the patches where that is measured (reflected_light()); 0 where nothing differs, infinite
  /// where only the first is dark.
  double rms = 0;
  /// Largest |difference| of a channel over the largest reflected light of the first result.
  double largest = 0;
  PatchId worst = no_patch;  ///< the patch with the largest difference; no_patch: nothing differs
  Rgb first;                 ///< its B in the first result, W/m²
  Rgb second;                ///< its B in the second result, W/m²
};

/// The difference over one group of patches.
struct GroupDifference {
  std::int32_t group = no_group;   ///< index into Scene::groups(), or no_group
  std::int64_t patches = 0;        ///< in the group
  RadiosityDifference difference;  ///< relative to the reflected light of the group
};

/// How two results of one scene differ.
struct ResultComparison {
  RadiosityDifference whole;            ///< over all patches
  std::vector<GroupDifference> groups;  ///< by Scene::groups() of the first, then the patches of
                                        ///< none; groups without patches are omitted
  std::string sky_difference = {};      ///< transillum::sky_difference()
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

/// Compares the B of two results of the same scene. Skies may differ.
/// @param first the reference of relative differences.
/// @param second the other one.
/// @throws InputError with scene_difference() where the scenes differ.
ResultComparison compare_results(const Solution& first, const Solution& second);

}  // namespace transillum
