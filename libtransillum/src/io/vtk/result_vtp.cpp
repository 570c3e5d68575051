// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Results as VTK PolyData. data/FILES.md lists the arrays; result_reader.cpp reads them back.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include "io/results/result_figures.h"
#include "io/results/result_writers.h"
#include "io/vtk/vtp_output.h"
#include "transillum/at.h"
#include "transillum/glossy.h"

namespace transillum {
namespace {

template <typename ValueOf>
void add_colors(vtkFieldData& fields, const char* name, PatchId count, ValueOf value_of) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(count);
  const char* const channels[] = {"r", "g", "b"};
  for (int c = 0; c < 3; ++c) {
    array->SetComponentName(c, channels[c]);
  }
  for (PatchId i = 0; i < count; ++i) {
    const Rgb rgb = value_of(i);
    array->SetTuple3(i, rgb.r, rgb.g, rgb.b);
  }
  fields.AddArray(array);
}

/// A polygon per patch with points of its own, and B at each of them.
void add_unshared_geometry(vtkPolyData& mesh, const Solution& solution) {
  const Scene& scene = *solution.scene;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> polygons;
  std::vector<Rgb> values;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    polygons->InsertNextCell(static_cast<int>(outline.size()));
    for (const PointId p : outline) {
      const Vec3& point = scene.point(p);
      polygons->InsertCellPoint(points->InsertNextPoint(point.x, point.y, point.z));
    }
    const std::vector<Rgb> corners = corner_radiosity(solution, i);
    values.insert(values.end(), corners.begin(), corners.end());
  }
  mesh.SetPoints(points);
  mesh.SetPolys(polygons);
  add_colors(*mesh.GetPointData(), "B_corner", static_cast<PatchId>(values.size()),
             [&](PatchId k) { return at(values, k); });
}

void add_geometry(vtkPolyData& mesh, const Scene& scene) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(scene.points().size()));
  for (std::size_t p = 0; p < scene.points().size(); ++p) {
    const Vec3& point = scene.points()[p];
    points->SetPoint(static_cast<vtkIdType>(p), point.x, point.y, point.z);
  }
  vtkNew<vtkCellArray> polygons;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    polygons->InsertNextCell(static_cast<int>(outline.size()));
    for (const PointId p : outline) {
      polygons->InsertCellPoint(p);
    }
  }
  mesh.SetPoints(points);
  mesh.SetPolys(polygons);
}

void add_patch_values(vtkFieldData& fields, const Solution& solution) {
  const Scene& scene = *solution.scene;
  const PatchId count = scene.patch_count();
  add_integers(fields, "face", count, [&](PatchId i) { return scene.patch(i).face; });
  add_integers(fields, "patch", count, [](PatchId i) { return i; });
  add_numbers(fields, "area", count, [&](PatchId i) { return scene.patch(i).area; });
  add_integers(fields, "material", count, [&](PatchId i) { return scene.patch(i).material; });
  add_colors(fields, "E", count, [&](PatchId i) { return scene.exitance(i); });
  add_colors(fields, "rho", count, [&](PatchId i) { return scene.reflectance(i); });
  add_colors(fields, "B", count, [&](PatchId i) { return at(solution.radiosity, i); });
  if (!solution.linear_parts.empty()) {
    add_colors(fields, "B1", count, [&](PatchId i) { return at(solution.linear_parts, i).first; });
    add_colors(fields, "B2", count, [&](PatchId i) { return at(solution.linear_parts, i).second; });
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
  if (!solution.sky_shares.empty()) {
    add_numbers(fields, "sky", count, [&](PatchId i) { return at(solution.sky_shares, i); });
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

/// The sky, where there is one.
void add_sky(vtkFieldData& fields, const Sky& sky) {
  if (!sky.set()) {
    return;
  }
  add_colors(fields, "sky_exitance", 1, [&](PatchId) { return sky.exitance; });
  add_field(fields, "sky_model", name_of(sky.model));
  vtkNew<vtkDoubleArray> up;
  up->SetName("sky_up");
  up->SetNumberOfComponents(3);
  up->InsertNextTuple3(sky.up.x, sky.up.y, sky.up.z);
  fields.AddArray(up);
}

template <class List, class NameOf>
void add_names(vtkFieldData& fields, const char* name, const List& list, NameOf name_of) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const auto& entry : list) {
    array->InsertNextValue(name_of(entry));
  }
  fields.AddArray(array);
}

/// Adds the options, statistics and error estimate of the solve as field data, for the viewer.
void add_solve_values(vtkFieldData& fields, const Solution& solution) {
  const Scene& scene = *solution.scene;
  add_field(fields, "transillum_version", std::string(TRANSILLUM_VERSION));
  add_field(fields, "scene", scene.name());
  add_names(fields, "materials", scene.materials(), [](const Material& m) { return m.name; });
  add_names(fields, "groups", scene.groups(), [](const std::string& group) { return group; });
  add_field(fields, "two_sided", scene.options().two_sided ? 1.0 : 0.0);
  add_field(fields, "max_patch_area", scene.options().max_patch_area);
  add_sky(fields, solution.sky);
  visit_figures(solution, [&](const char* name, const auto& value) {
    add_field(fields, name, static_cast<double>(value));
  });
  if (solution.glossy && solution.eye) {
    vtkNew<vtkDoubleArray> eye;
    eye->SetName("eye");
    eye->SetNumberOfComponents(3);
    eye->InsertNextTuple3(solution.eye->x, solution.eye->y, solution.eye->z);
    fields.AddArray(eye);
  }
  const auto& steps = solution.statistics.iteration_records;
  const int count = static_cast<int>(steps.size());
  add_numbers(fields, "change", count, [&](int k) { return at(steps, k).change; });
  add_numbers(fields, "contraction", count, [&](int k) { return at(steps, k).contraction; });
}

}  // namespace

void write_result_vtp(std::ostream& out, const Solution& solution) {
  vtkNew<vtkPolyData> mesh;
  if (solution.linear_parts.empty()) {
    add_geometry(*mesh, *solution.scene);
  } else {
    add_unshared_geometry(*mesh, solution);
  }
  add_patch_values(*mesh->GetCellData(), solution);
  mesh->GetCellData()->SetActiveScalars("B");
  add_solve_values(*mesh->GetFieldData(), solution);

  write_polygons(out, *mesh);
}

}  // namespace transillum
