// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/maps/map_writers.h"
#include "io/vtp_writer.h"
#include "transillum/at.h"

namespace transillum {
namespace {

void add_vector(VtpArrays& fields, const char* name, const Vec3& vector) {
  add_array(fields, name, std::vector{vector.x, vector.y, vector.z});
}

/// The polygons of a map, followed by the differences if it is a map in pixels.
std::vector<VisibilityMap::Polygon> all_polygons(const VisibilityMap& map) {
  std::vector<VisibilityMap::Polygon> all = map.polygons;
  all.insert(all.end(), map.pixels.differences.begin(), map.pixels.differences.end());
  return all;
}

void add_polygons(VtpPolygons& mesh, const VisibilityMap& map,
                  const std::vector<VisibilityMap::Polygon>& polygons) {
  for (const VisibilityMap::Polygon& polygon : polygons) {
    for (const Vec2& p : map.outline(polygon)) {
      mesh.corners.push_back(mesh.add_point({p.x, p.y, 0}));
    }
    mesh.ends.push_back(std::ssize(mesh.corners));
  }
}

}  // namespace

void write_map_vtp(std::ostream& out, const Scene& scene, const VisibilityMap& map) {
  VtpPolygons mesh;
  const std::vector<VisibilityMap::Polygon> polygons = all_polygons(map);
  add_polygons(mesh, map, polygons);
  VtpArrays& cells = mesh.cell_data;
  const auto count = static_cast<int>(polygons.size());
  const auto polygon = [&](int k) -> const auto& { return at(polygons, k); };
  add_integers(cells, "patch", count, [&](int k) { return polygon(k).patch; });
  add_integers(cells, "front", count, [&](int k) { return polygon(k).front_facing ? 1 : 0; });
  add_numbers(cells, "area", count, [&](int k) { return polygon(k).area; });
  if (map.pixels.side > 0) {
    const auto drawn = static_cast<int>(map.polygons.size());
    add_integers(cells, "difference", count, [&](int k) { return k < drawn ? 0 : 1; });
  }
  mesh.scalars = "patch";

  VtpArrays& fields = mesh.fields;
  add_array(fields, "transillum_version", std::vector<std::string>{TRANSILLUM_VERSION});
  add_array(fields, "scene", std::vector{scene.name()});
  add_integers(fields, "receiver", 1, [&](int) { return map.receiver; });
  add_vector(fields, "direction", map.frame.omega);
  add_vector(fields, "origin", map.frame.origin);
  add_vector(fields, "u", map.frame.u);
  add_vector(fields, "v", map.frame.v);
  write_polygons(out, mesh);
}

}  // namespace transillum
