// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/slow_quantities.h"

#include "model/snapshot_values.h"
#include "transillum/refinement.h"

namespace transillum::viewer {

PatchJumps find_jumps(const std::shared_ptr<const SolverSnapshot>& snapshot,
                      const Cancellation& cancellation) {
  // Uses the current materials, which the user may have changed.
  std::vector<Rgb> reflectance;
  for (PatchId i = 0; i < snapshot->loaded->scene->patch_count(); ++i) {
    const Material& material = material_of(*snapshot, i);
    reflectance.push_back(snapshot->glossy ? material.reflectance + used_lobe(material).reflectance
                                           : material.reflectance);
  }
  return {snapshot->loaded->scene,
          radiosity_jumps(solution_of(*snapshot), reflectance, cancellation)};
}

RadianceToward radiance_toward(const EyeRequest& request, const Cancellation&) {
  return {request.light, request.light->radiance_toward(request.eye)};
}

PatchResponse solve_response(const LightRequest& request, const Cancellation& cancellation) {
  return {request.loaded, request.receiver,
          solve_adjoint(
              request.scene(), *request.form_factors, request.receiver, request.material_list(),
              {.tolerance = request.tolerance, .patch_materials = request.patch_materials()},
              cancellation)};
}

}  // namespace transillum::viewer
