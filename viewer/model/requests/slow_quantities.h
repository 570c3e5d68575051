// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Quantities of all patches that take too long to compute for the thread of the window.
#pragma once

#include <memory>
#include <vector>

#include "model/requests/light_request.h"
#include "model/snapshot.h"
#include "transillum/adjoint.h"
#include "transillum/cancellation.h"
#include "transillum/glossy.h"

namespace transillum::viewer {

/// By how much B of each patch differs from that of its neighbors.
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

/// What light emitted by each patch does to one patch.
struct PatchResponse {
  std::shared_ptr<const LoadedScene> loaded;
  PatchId receiver = no_patch;
  Adjoint adjoint;
};
/// Solves the adjoint for a patch, from the form factors of a snapshot.
PatchResponse solve_response(const LightRequest& request, const Cancellation& cancellation);

}  // namespace transillum::viewer
