// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "io/maps/map_writers.h"
#include "io/vtk/vtp_output.h"
#include "transillum/at.h"

namespace transillum {
namespace {

void add_vector(vtkFieldData& fields, const char* name, const Vec3& vector) {
  const double xyz[] = {vector.x, vector.y, vector.z};
  add_numbers(fields, name, 3, [&](int k) { return xyz[k]; });
}

/// The polygons of a map, followed by the differences if it is a map in pixels.
std::vector<VisibilityMap::Polygon> all_polygons(const VisibilityMap& map) {
  std::vector<VisibilityMap::Polygon> all = map.polygons;
  all.insert(all.end(), map.pixels.differences.begin(), map.pixels.differences.end());
  return all;
}

void add_polygons(vtkPolyData& mesh, const VisibilityMap& map,
                  const std::vector<VisibilityMap::Polygon>& polygons) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const VisibilityMap::Polygon& polygon : polygons) {
    const auto outline = map.outline(polygon);
    cells->InsertNextCell(static_cast<int>(outline.size()));
    for (const Vec2& p : outline) {
      cells->InsertCellPoint(points->InsertNextPoint(p.x, p.y, 0));
    }
  }
  mesh.SetPoints(points);
  mesh.SetPolys(cells);
}

}  // namespace

void write_map_vtp(std::ostream& out, const Scene& scene, const VisibilityMap& map) {
  vtkNew<vtkPolyData> mesh;
  const std::vector<VisibilityMap::Polygon> polygons = all_polygons(map);
  add_polygons(*mesh, map, polygons);
  vtkFieldData& cells = *mesh->GetCellData();
  const auto count = static_cast<int>(polygons.size());
  const auto polygon = [&](int k) -> const auto& { return at(polygons, k); };
  add_integers(cells, "patch", count, [&](int k) { return polygon(k).patch; });
  add_integers(cells, "front", count, [&](int k) { return polygon(k).front_facing ? 1 : 0; });
  add_numbers(cells, "area", count, [&](int k) { return polygon(k).area; });
  if (map.pixels.side > 0) {
    const auto drawn = static_cast<int>(map.polygons.size());
    add_integers(cells, "difference", count, [&](int k) { return k < drawn ? 0 : 1; });
  }
  mesh->GetCellData()->SetActiveScalars("patch");

  vtkFieldData& fields = *mesh->GetFieldData();
  add_field(fields, "transillum_version", std::string(TRANSILLUM_VERSION));
  add_field(fields, "scene", scene.name());
  add_integers(fields, "receiver", 1, [&](int) { return map.receiver; });
  add_vector(fields, "direction", map.frame.omega);
  add_vector(fields, "origin", map.frame.origin);
  add_vector(fields, "u", map.frame.u);
  add_vector(fields, "v", map.frame.v);
  write_polygons(out, *mesh);
}

}  // namespace transillum
