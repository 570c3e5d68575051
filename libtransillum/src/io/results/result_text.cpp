// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Results as text: CSV, PLY and OBJ. data/FILES.md lists their columns and properties.
#include "io/results/result_writers.h"
#include "io/text_buffer.h"
#include "transillum/at.h"
#include "transillum/files.h"

namespace transillum {
namespace {

void add_color(TextBuffer& text, const Rgb& rgb, char separator) {
  text.add("{}{}{}{}{}{}", separator, rgb.r, separator, rgb.g, separator, rgb.b);
}

/// Writes face, patch, area, E, rho and B of patch i. fmt's "{}" of a double is the shortest text
/// that reads back to the same bits.
void add_patch_values(TextBuffer& text, const Solution& solution, PatchId i, char separator) {
  const Scene& scene = *solution.scene;
  const Patch& patch = scene.patch(i);
  text.add("{}{}{}{}{}", patch.face, separator, i, separator, patch.area);
  for (const Rgb& rgb : {scene.exitance(i), scene.reflectance(i), at(solution.radiosity, i)}) {
    add_color(text, rgb, separator);
  }
}

bool has_large_outlines(const Scene& scene) {
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (scene.outline(i).size() > 255) {
      return true;
    }
  }
  return false;
}

}  // namespace

/// One line per patch: face,patch,area,E_r,E_g,E_b,rho_r,rho_g,rho_b,B_r,B_g,B_b; with replicas
/// also SE_r,SE_g,SE_b.
void write_result_csv(std::ostream& out, const Solution& solution) {
  TextBuffer text(out);
  const std::vector<Rgb>& errors = solution.error.standard_error;
  text.add("face,patch,area,E_r,E_g,E_b,rho_r,rho_g,rho_b,B_r,B_g,B_b{}\n",
           errors.empty() ? "" : ",SE_r,SE_g,SE_b");
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    add_patch_values(text, solution, i, ',');
    if (!errors.empty()) {
      add_color(text, at(errors, i), ',');
    }
    text.add("\n");
  }
}

void write_result_ply(std::ostream& out, const Solution& solution) {
  const Scene& scene = *solution.scene;
  TextBuffer text(out);
  text.add("ply\nformat ascii 1.0\ncomment transillum; lengths in m, E and B in W/m2\n");
  text.add("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
           scene.points().size());
  // Most readers support only lists whose length is a byte.
  text.add("element face {}\nproperty list {} int vertex_indices\n", scene.patch_count(),
           has_large_outlines(scene) ? "uint" : "uchar");
  text.add("property int face\nproperty int patch\n");
  for (const char* name :
       {"area", "E_r", "E_g", "E_b", "rho_r", "rho_g", "rho_b", "B_r", "B_g", "B_b"}) {
    text.add("property double {}\n", name);
  }
  text.add("end_header\n");
  for (const Vec3& p : scene.points()) {
    text.add("{} {} {}\n", p.x, p.y, p.z);
  }
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const auto outline = scene.outline(i);
    text.add("{} ", outline.size());
    for (const PointId p : outline) {
      text.add("{} ", p);
    }
    add_patch_values(text, solution, i, ' ');
    text.add("\n");
  }
}

void write_result_obj(std::ostream& out, const Solution& solution) {
  const Scene& scene = *solution.scene;
  TextBuffer text(out);
  text.add(
      "# transillum: one face per patch; v x y z r g b, where r g b is the patch's radiosity B, "
      "W/m2, linear\n");
  std::int64_t corner = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Rgb& b = at(solution.radiosity, i);
    for (const PointId id : scene.outline(i)) {
      const Vec3& p = scene.point(id);
      text.add("v {} {} {} {} {} {}\n", p.x, p.y, p.z, b.r, b.g, b.b);
    }
    text.add("f");
    for (std::size_t k = 0; k < scene.outline(i).size(); ++k) {
      text.add(" {}", ++corner);
    }
    text.add("\n");
  }
}

}  // namespace transillum
