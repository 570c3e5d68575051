// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/slow_quantities.h"

#include <algorithm>

#include "model/snapshot_values.h"
#include "radiosity/sun_light.h"
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

CostRequest cost_request(const SolverSnapshot& snapshot) {
  return {snapshot.loaded, snapshot.directions_of(0), snapshot.options.engine,
          snapshot.options.basis == Basis::linear};
}

MeasuredCosts measure_costs(const CostRequest& request, const Cancellation& cancellation) {
  const LoadedScene& loaded = *request.loaded;
  const std::vector<Vec3> directions =
      request.directions ? directions_to_measure(*request.directions) : std::vector<Vec3>();
  return {request.loaded, patch_costs(request.engine, loaded.scene, loaded.tree, directions,
                                      request.moments, cancellation)};
}

std::vector<Rgb> light_of_sun(const LightRequest& request, const Cancellation& cancellation) {
  return request.sky.empty()
             ? std::vector<Rgb>()
             : sun_light(request.loaded->scene, request.loaded->tree, request.options, cancellation)
                   .irradiance;
}

PatchResponse solve_response(const LightRequest& request, const Cancellation& cancellation) {
  PatchResponse response{
      request.loaded, request.receiver,
      solve_adjoint(
          request.scene(), *request.form_factors, request.receiver, request.material_list(),
          {.tolerance = request.options.tolerance, .patch_materials = request.patch_materials()},
          cancellation)};
  const std::vector<Rgb> sun = light_of_sun(request, cancellation);
  const Scene& scene = request.scene();
  for (PatchId j = 0; j < scene.patch_count() && !request.sky.empty(); ++j) {
    const Material& material = request.materials ? request.materials->of(j) : scene.material(j);
    const Rgb effect =
        scene.patch(j).area * (at(response.adjoint.per_watt, j) * material.reflectance);
    const Rgb of_sun = sun.empty() ? Rgb() : at(sun, j);
    response.from_sun += effect * of_sun;
    response.from_sky += effect * (at(request.sky, j) - of_sun);
  }
  return response;
}

std::optional<RowRequest> row_request(const SolverSnapshot& snapshot, PatchId receiver) {
  const int iterations = snapshot.progress.iteration;
  const SolveOptions& options = snapshot.options;
  const bool all_rows = options.normalize == Normalization::symmetric;
  if (iterations == 0 || snapshot.glossy || (all_rows && !snapshot.form_factors)) {
    return std::nullopt;
  }
  RowRequest request{snapshot.loaded,
                     snapshot.form_factors,
                     {},
                     static_cast<std::size_t>(snapshot.passes_of(iterations - 1)),
                     options,
                     receiver};
  const bool renews = traits_of(options.scheme).renews_directions;
  const int first = renews ? std::min(snapshot.statistics.burn_in, iterations - 1) : iterations - 1;
  for (int iteration = first; iteration < iterations; ++iteration) {
    request.directions.push_back(snapshot.directions_of(iteration));
  }
  return request;
}

PatchRow compute_row(const RowRequest& request, const Cancellation& cancellation,
                     const std::function<void(double)>& progress) {
  PatchRow result{request.loaded, request.receiver, {}};
  const LoadedScene& loaded = *request.loaded;
  if (request.form_factors) {
    result.row = row_of(*request.form_factors, request.receiver);
    result.row.sun =
        sun_on_patch(loaded.scene, loaded.tree, request.receiver, request.options, cancellation);
    return result;
  }
  std::vector<Vec3> directions;
  for (const auto& set : request.directions) {
    const std::size_t passes = std::min(request.passes, set->size());
    directions.insert(directions.end(), set->begin(),
                      set->begin() + static_cast<std::ptrdiff_t>(passes));
  }
  result.row = receiver_row(loaded.scene, loaded.tree, request.receiver, directions,
                            request.options, cancellation, progress);
  return result;
}

}  // namespace transillum::viewer
