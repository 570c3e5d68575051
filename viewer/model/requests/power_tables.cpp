// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/requests/power_tables.h"

#include <span>

#include "model/snapshot_values.h"
#include "radiosity/sun_light.h"

namespace transillum::viewer {

PowerTables power_tables(const std::shared_ptr<const SolverSnapshot>& snapshot) {
  PowerTables tables;
  tables.snapshot = snapshot;
  tables.received_known = snapshot->of_file || snapshot->progress.iteration > 0;
  Solution solution = solution_of(*snapshot);
  if (!tables.received_known) {
    solution.irradiance.assign(solution.radiosity.size(), Rgb{});
    solution.sky_irradiance.clear();
  }
  std::span<const Material> materials;
  std::span<const std::int32_t> patch_materials;
  if (snapshot->materials) {
    materials = snapshot->materials->materials;
    patch_materials = snapshot->materials->of_patch;
  }
  const SunLight sun =
      solution.sky_irradiance.empty()
          ? SunLight()
          : sun_light(snapshot->loaded->scene, snapshot->loaded->tree, {.sky = solution.sky}, {});
  const auto table = [&](SurfaceKind by) {
    return power_table(solution, by, snapshot->form_factors.get(), materials, patch_materials,
                       sun.irradiance);
  };
  tables.groups = table(SurfaceKind::group);
  tables.materials = table(SurfaceKind::material);
  return tables;
}

}  // namespace transillum::viewer
