// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// E and rho of all patches of a scene, with the user's changes. The materials of the scene come
/// first, in its order; the materials of faces and groups with values of their own follow.
struct PatchMaterials {
  std::vector<Material> materials;
  std::vector<std::int32_t> of_patch;  ///< index into `materials` for each patch

  /// Material of patch i.
  const Material& of(PatchId i) const { return at(materials, at(of_patch, i)); }
  /// The largest reflectance of a patch.
  double rho_max() const {
    double largest = 0;
    for (const std::int32_t material : of_patch) {
      largest = std::max(largest, max_abs(at(materials, material).reflectance));
    }
    return largest;
  }
  /// Whether a patch emits.
  bool has_light() const {
    return std::any_of(of_patch.begin(), of_patch.end(), [this](std::int32_t material) {
      return max_abs(at(materials, material).exitance) > 0;
    });
  }
};

}  // namespace transillum::viewer
