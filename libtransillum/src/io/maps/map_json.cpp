// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <nlohmann/json.hpp>

#include "io/maps/map_drawing.h"
#include "io/maps/map_writers.h"
#include "io/text.h"

namespace transillum {
namespace {

// Maps have hundreds of thousands of numbers, so they are written without building a document in
// memory. fmt's "{}" of a double is the shortest text that reads back to the same bits.

void add_vector(TextBuffer& text, const char* name, const Vec3& v, const char* after) {
  text.add("\"{}\": [{}, {}, {}]{}", name, v.x, v.y, v.z, after);
}

/// Writes a list, one line per polygon.
void add_polygons(TextBuffer& text, const VisibilityMap& map,
                  const std::vector<VisibilityMap::Polygon>& polygons, const char* indent) {
  const char* before = "";
  text.add("[");
  for (const VisibilityMap::Polygon& polygon : polygons) {
    text.add("{}\n{}{{\"patch\": {}, \"facing\": \"{}\", \"area\": {}, \"corners\": [", before,
             indent, polygon.patch, polygon.front_facing ? "front" : "back", polygon.area);
    const char* comma = "";
    for (const Vec2& p : map.outline(polygon)) {
      text.add("{}[{}, {}]", comma, p.x, p.y);
      comma = ", ";
    }
    text.add("]}}");
    before = ",";
  }
  text.add("]");
}

}  // namespace

void write_map_json(std::ostream& out, const Scene& scene, const VisibilityMap& map) {
  TextBuffer text(out);
  // A scene's name may be a file name, which need not be UTF-8; JSON must be.
  const std::string name =
      nlohmann::json(scene.name()).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  text.add("{{\n  \"program\": \"transillum " TRANSILLUM_VERSION "\",\n  \"scene\": {},\n", name);
  text.add("  \"patches\": {},\n  \"frame\": {{", scene.patch_count());
  add_vector(text, "origin", map.frame.origin, ", ");
  add_vector(text, "u", map.frame.u, ", ");
  add_vector(text, "v", map.frame.v, ", ");
  add_vector(text, "omega", map.frame.omega, "},\n");
  if (map.receiver == no_patch) {
    text.add("  \"receiver\": null,\n");
  } else {
    text.add("  \"receiver\": {{\"patch\": {}, \"area\": {}, \"polygons\": ", map.receiver,
             total_area(map.window));
    add_polygons(text, map, map.window, "    ");
    text.add("}},\n");
  }
  text.add("  \"area\": {},\n  \"polygons\": ", total_area(map.polygons));
  add_polygons(text, map, map.polygons, "    ");
  if (map.pixels.side > 0) {
    text.add(",\n  \"pixel\": {},\n  \"differing_area\": {},\n  \"differences\": ", map.pixels.side,
             total_area(map.pixels.differences));
    add_polygons(text, map, map.pixels.differences, "    ");
  }
  text.add("\n}}\n");
}

}  // namespace transillum
