// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Results as VTK PolyData. data/FILES.md lists the arrays; result_reader.cpp reads them back.
#include "io/results/result_values.h"
#include "io/results/result_writers.h"
#include "io/vtp_writer.h"
#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

template <typename ValueOf>
void add_colors(VtpArrays& fields, const char* name, PatchId count, ValueOf value_of) {
  std::vector<double> values;
  for (PatchId i = 0; i < count; ++i) {
    const Rgb rgb = value_of(i);
    values.insert(values.end(), {rgb.r, rgb.g, rgb.b});
  }
  add_array(fields, name, values, VtpEntries::colors);
}

/// A polygon per patch with points of its own, and B at each of them.
void add_unshared_geometry(VtpPolygons& mesh, const Solution& solution) {
  const Scene& scene = *solution.scene;
  std::vector<Rgb> values;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId p : scene.outline(i)) {
      mesh.corners.push_back(mesh.add_point(scene.point(p)));
    }
    mesh.ends.push_back(std::ssize(mesh.corners));
    const std::vector<Rgb> corners = corner_radiosity(solution, i);
    values.insert(values.end(), corners.begin(), corners.end());
  }
  add_colors(mesh.point_data, "B_corner", static_cast<PatchId>(values.size()),
             [&](PatchId k) { return at(values, k); });
}

void add_geometry(VtpPolygons& mesh, const Scene& scene) {
  for (const Vec3& point : scene.points()) {
    mesh.add_point(point);
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    mesh.corners.insert(mesh.corners.end(), outline.begin(), outline.end());
    mesh.ends.push_back(std::ssize(mesh.corners));
  }
}

void add_patch_values(VtpArrays& fields, const Solution& solution) {
  const Scene& scene = *solution.scene;
  const PatchId count = scene.patch_count();
  add_integers(fields, "face", count, [&](PatchId i) { return scene.patch(i).face; });
  add_integers(fields, "patch", count, [](PatchId i) { return i; });
  add_numbers(fields, "area", count, [&](PatchId i) { return scene.patch(i).area; });
  add_integers(fields, "material", count, [&](PatchId i) { return scene.patch(i).material; });
  add_colors(fields, "E", count, [&](PatchId i) { return scene.exitance(i); });
  add_colors(fields, "rho", count, [&](PatchId i) { return scene.reflectance(i); });
  add_colors(fields, "B", count, [&](PatchId i) { return at(solution.radiosity, i); });
  if (!solution.linear_terms.empty()) {
    add_colors(fields, "B1", count, [&](PatchId i) { return at(solution.linear_terms, i).first; });
    add_colors(fields, "B2", count, [&](PatchId i) { return at(solution.linear_terms, i).second; });
  }
  if (!solution.error.standard_error.empty()) {
    add_colors(fields, "standard_error", count,
               [&](PatchId i) { return at(solution.error.standard_error, i); });
  }
  add_colors(fields, "H", count, [&](PatchId i) { return at(solution.irradiance, i); });
  if (!solution.form_factor_sums.empty()) {
    add_numbers(fields, "F_sum", count,
                [&](PatchId i) { return at(solution.form_factor_sums, i); });
  }
  if (!solution.sky_fractions.empty()) {
    add_numbers(fields, "sky", count, [&](PatchId i) { return at(solution.sky_fractions, i); });
  }
  if (!solution.sky_irradiance.empty()) {
    add_colors(fields, "H_sky", count, [&](PatchId i) { return at(solution.sky_irradiance, i); });
  }
  add_integers(fields, "group", count, [&](PatchId i) { return scene.patch(i).group; });
  if (solution.glossy) {
    add_colors(fields, "rho_lobe", count,
               [&](PatchId i) { return used_lobe(scene.material(i)).reflectance; });
  }
  if (solution.glossy && solution.eye) {
    const std::vector<Rgb> seen = solution.glossy->radiance_toward(*solution.eye);
    add_colors(fields, "L", count, [&](PatchId i) { return at(seen, i); });
  }
}

void add_field(VtpArrays& fields, const char* name, double value) {
  add_array(fields, name, std::vector{value});
}

void add_field(VtpArrays& fields, const char* name, const std::string& value) {
  add_array(fields, name, std::vector{value});
}

void add_vector(VtpArrays& fields, const char* name, const Vec3& vector) {
  add_array(fields, name, std::vector{vector.x, vector.y, vector.z}, VtpEntries::vectors);
}

/// Sky and sun, where there is one.
void add_sky(VtpArrays& fields, const Sky& sky) {
  if (!sky.is_set()) {
    return;
  }
  add_colors(fields, "sky_exitance", 1, [&](PatchId) { return sky.exitance; });
  add_field(fields, "sky_model", name_of(sky.model));
  add_vector(fields, "sky_up", sky.up);
  if (sky.sun.is_set()) {
    add_colors(fields, "sun_irradiance", 1, [&](PatchId) { return sky.sun.irradiance; });
    add_vector(fields, "sun_direction", sky.sun.direction);
    add_field(fields, "sun_disc", sky.sun.disc ? 1.0 : 0.0);
  }
}

/// Adds the options, statistics and error estimate of the solve as field data, for the viewer.
void add_solve_values(VtpArrays& fields, const Solution& solution) {
  const Scene& scene = *solution.scene;
  add_field(fields, "transillum_version", std::string(TRANSILLUM_VERSION));
  add_field(fields, "scene", scene.name());
  std::vector<std::string> materials;
  for (const Material& material : scene.materials()) {
    materials.push_back(material.name);
  }
  add_array(fields, "materials", materials);
  add_array(fields, "groups", scene.groups());
  add_field(fields, "two_sided", scene.options().two_sided ? 1.0 : 0.0);
  add_field(fields, "max_patch_area", scene.options().max_patch_area);
  add_sky(fields, solution.sky);
  visit_values(solution, [&](const char* name, const auto& value) {
    add_field(fields, name, static_cast<double>(value));
  });
  if (solution.glossy && solution.eye) {
    add_vector(fields, "eye", *solution.eye);
  }
  const auto& steps = solution.statistics.iteration_records;
  const int count = static_cast<int>(steps.size());
  add_numbers(fields, "change", count, [&](int k) { return at(steps, k).change; });
  add_numbers(fields, "contraction", count, [&](int k) { return at(steps, k).contraction; });
}

}  // namespace

void write_result_vtp(std::ostream& out, const Solution& solution) {
  VtpPolygons mesh;
  if (solution.linear_terms.empty()) {
    add_geometry(mesh, *solution.scene);
  } else {
    add_unshared_geometry(mesh, solution);
  }
  add_patch_values(mesh.cell_data, solution);
  mesh.scalars = "B";
  add_solve_values(mesh.fields, solution);

  write_polygons(out, mesh);
}

}  // namespace transillum
