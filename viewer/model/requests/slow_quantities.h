// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Questions about the light of patches that take too long to answer for the thread of the window.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/snapshot.h"
#include "radiosity/form_factors/receiver_row.h"
#include "transillum/adjoint.h"
#include "transillum/cancellation.h"
#include "transillum/glossy.h"
#include "visibility/fast/patch_costs.h"

namespace transillum::viewer {

/// A question about the light of one patch, to be answered from form factors on another thread.
struct LightRequest {
  std::shared_ptr<const LoadedScene> loaded;
  std::shared_ptr<const FormFactors> form_factors;
  std::shared_ptr<const PatchMaterials> materials;  ///< null for the materials of the scene
  PatchId receiver = no_patch;
  SolveOptions options;  ///< options of the solve run
  std::vector<Rgb> sky;  ///< light that each patch receives from sky and sun; may be empty

  const Scene& scene() const { return *loaded->scene; }
  const std::vector<Material>& material_list() const {
    return materials ? materials->materials : scene().materials();
  }
  /// Index into material_list() for each patch; empty if Patch::material is that index.
  std::span<const std::int32_t> patch_materials() const {
    return materials ? std::span<const std::int32_t>(materials->of_patch)
                     : std::span<const std::int32_t>();
  }
  friend bool operator==(const LightRequest& a, const LightRequest& b) {
    // The light of the sky belongs to the form factors.
    return a.loaded == b.loaded && a.form_factors == b.form_factors && a.materials == b.materials &&
           a.receiver == b.receiver && a.options == b.options;
  }
};
/// The part of LightRequest::sky that the sun gives; empty without a sun.
std::vector<Rgb> light_of_sun(const LightRequest& request, const Cancellation& cancellation);

/// The request for a snapshot; not set where the snapshot has no form factors or no such patch.
inline std::optional<LightRequest> light_request(const SolverSnapshot& snapshot, PatchId receiver) {
  if (!snapshot.form_factors || receiver < 0 || receiver >= snapshot.loaded->scene->patch_count()) {
    return std::nullopt;
  }
  return LightRequest{snapshot.loaded, snapshot.form_factors, snapshot.materials,
                      receiver,        snapshot.options,      snapshot.sky_irradiance};
}

/// The difference between B of each patch and B of its neighbors.
struct PatchJumps {
  std::shared_ptr<const Scene> scene;
  std::vector<double> values;  ///< radiosity_jumps(), W/m², one per patch
};
PatchJumps find_jumps(const std::shared_ptr<const SolverSnapshot>& snapshot,
                      const Cancellation& cancellation);

/// A light whose last reflection is evaluated for an eye.
struct EyeRequest {
  std::shared_ptr<const GlossyLight> light;
  Vec3 eye;  ///< m

  friend bool operator==(const EyeRequest& a, const EyeRequest& b) {
    return a.light == b.light && a.eye == b.eye;
  }
};
/// Radiance of all patches toward a point.
struct RadianceToward {
  std::shared_ptr<const GlossyLight> light;
  std::vector<Rgb> values;  ///< W/(m² sr), one per patch
};
RadianceToward radiance_toward(const EyeRequest& request, const Cancellation& cancellation);

/// A solve of whose passes some are run again, to measure their cost.
struct CostRequest {
  std::shared_ptr<const LoadedScene> loaded;
  std::shared_ptr<const std::vector<Vec3>> directions;  ///< the first iteration's; may be null
  Engine engine = Engine::fast;
  bool moments = false;  ///< its functions are linear

  friend bool operator==(const CostRequest&, const CostRequest&) = default;
};
CostRequest cost_request(const SolverSnapshot& snapshot);
/// The cost of passes, and of what scene.
struct MeasuredCosts {
  std::shared_ptr<const LoadedScene> loaded;
  PatchCosts costs;
};
/// @throws InputError where the engine has no cost by patch, or no pass was made
MeasuredCosts measure_costs(const CostRequest& request, const Cancellation& cancellation);

/// The effect that light emitted by each patch has on one patch.
struct PatchResponse {
  std::shared_ptr<const LoadedScene> loaded;
  PatchId receiver = no_patch;
  Adjoint adjoint;
  Rgb from_sky = {},
      from_sun = {};  ///< parts of its B that come from sky and sun, by all light paths, W/m²
};
/// Solves the adjoint for a patch, from the form factors of a snapshot.
PatchResponse solve_response(const LightRequest& request, const Cancellation& cancellation);

/// A row of form factors, to be computed again from the directions of a solve.
struct RowRequest {
  std::shared_ptr<const LoadedScene> loaded;
  std::shared_ptr<const FormFactors> form_factors;  ///< that have the row; may be null
  /// One set; several where each iteration has its own.
  std::vector<std::shared_ptr<const std::vector<Vec3>>> directions;
  std::size_t passes = 0;  ///< how many directions of each set, from the first
  SolveOptions options;
  PatchId receiver = no_patch;

  friend bool operator==(const RowRequest&, const RowRequest&) = default;
};
/// The request for the row that the last iteration of a snapshot had; not set before its first
/// iteration has ended, and where only all rows together can be computed.
std::optional<RowRequest> row_request(const SolverSnapshot& snapshot, PatchId receiver);
/// A row that was computed, and of what.
struct PatchRow {
  std::shared_ptr<const LoadedScene> loaded;
  PatchId receiver = no_patch;
  ReceiverRow row;
};
/// @param progress called with the fraction done, on the same thread
PatchRow compute_row(const RowRequest& request, const Cancellation& cancellation,
                     const std::function<void(double)>& progress);

}  // namespace transillum::viewer
