// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/snapshot.h"

namespace transillum::viewer {

/// A question about the light of one patch, to be answered from form factors on another thread.
struct LightRequest {
  std::shared_ptr<const LoadedScene> loaded;
  std::shared_ptr<const FormFactors> form_factors;
  std::shared_ptr<const PatchMaterials> materials;  ///< null for the materials of the scene
  PatchId receiver = no_patch;
  double tolerance = 0;  ///< tolerance of the solve run

  const Scene& scene() const { return *loaded->scene; }
  const std::vector<Material>& material_list() const {
    return materials ? materials->materials : scene().materials();
  }
  /// Index into material_list() for each patch; empty if Patch::material is that index.
  std::span<const std::int32_t> patch_materials() const {
    return materials ? std::span<const std::int32_t>(materials->of_patch)
                     : std::span<const std::int32_t>();
  }
  friend bool operator==(const LightRequest&, const LightRequest&) = default;
};

/// The request for a snapshot; not set where the snapshot has no form factors or no such patch.
inline std::optional<LightRequest> light_request(const SolverSnapshot& snapshot, PatchId receiver) {
  if (!snapshot.form_factors || receiver < 0 || receiver >= snapshot.loaded->scene->patch_count()) {
    return std::nullopt;
  }
  return LightRequest{snapshot.loaded, snapshot.form_factors, snapshot.materials, receiver,
                      snapshot.options.tolerance};
}

}  // namespace transillum::viewer
