// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Results as text: CSV, PLY and OBJ. data/FILES.md lists their columns and properties.
#include <numbers>

#include "io/results/result_writers.h"
#include "io/srgb.h"
#include "io/text.h"
#include "transillum/at.h"
#include "transillum/files.h"
#include "transillum/glossy.h"

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

/// A name as a cell of a CSV file: in quotes where it contains what separates cells.
std::string csv_cell(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) {
    return name;
  }
  std::string cell = "\"";
  for (const char c : name) {
    cell += c == '"' ? "\"\"" : std::string(1, c);
  }
  return cell + '"';
}

/// Writes H, row sum of F and fraction of the sky where they are known, group and material.
void add_light_and_names(TextBuffer& text, const Solution& solution, PatchId i) {
  const Scene& scene = *solution.scene;
  add_color(text, at(solution.irradiance, i), ',');
  if (!solution.form_factor_sums.empty()) {
    text.add(",{}", at(solution.form_factor_sums, i));
  }
  if (!solution.sky_fractions.empty()) {
    text.add(",{}", at(solution.sky_fractions, i));
  }
  const std::int32_t group = scene.patch(i).group;
  text.add(",{},{}", group == no_group ? std::string() : csv_cell(at(scene.groups(), group)),
           csv_cell(scene.material(i).name));
}

/// Radiance of each patch toward Solution::eye; empty without one.
std::vector<Rgb> radiance_toward_eye(const Solution& solution) {
  return solution.eye && solution.glossy ? solution.glossy->radiance_toward(*solution.eye)
                                         : std::vector<Rgb>();
}

/// The columns of lobes.
std::string lobes_header(const Solution& solution, bool eye) {
  return std::string(solution.glossy ? ",rho_lobe_r,rho_lobe_g,rho_lobe_b" : "") +
         (eye ? ",L_r,L_g,L_b" : "");
}

/// Writes the linear term of B, and the functions by which it is multiplied.
void add_linear_term(TextBuffer& text, const Solution& solution, PatchId i) {
  const LinearTerm& term = at(solution.linear_terms, i);
  add_color(text, term.first, ',');
  add_color(text, term.second, ',');
  const LinearBasis basis = linear_basis(*solution.scene, i);
  for (const Vec3& v : {basis.center, basis.gradient[0], basis.gradient[1]}) {
    text.add(",{},{},{}", v.x, v.y, v.z);
  }
}

std::size_t corner_count(const Scene& scene) {
  std::size_t count = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    count += scene.outline(i).size();
  }
  return count;
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
/// also SE_r,SE_g,SE_b; then H_r,H_g,H_b, F_sum and sky where they are known, group,material; with
/// a linear basis also coefficients, center and gradients; with lobes what they reflect, and toward
/// an eye L.
void write_result_csv(std::ostream& out, const Solution& solution) {
  TextBuffer text(out);
  const std::vector<Rgb>& errors = solution.error.standard_error;
  const std::vector<Rgb> seen = radiance_toward_eye(solution);
  text.add(
      "face,patch,area,E_r,E_g,E_b,rho_r,rho_g,rho_b,B_r,B_g,B_b{},H_r,H_g,H_b{}{},group,"
      "material{}{}\n",
      errors.empty() ? "" : ",SE_r,SE_g,SE_b", solution.form_factor_sums.empty() ? "" : ",F_sum",
      solution.sky_fractions.empty() ? "" : ",sky",
      solution.linear_terms.empty()
          ? ""
          : ",B1_r,B1_g,B1_b,B2_r,B2_g,B2_b,c_x,c_y,c_z,g1_x,g1_y,g1_z,g2_x,g2_y,g2_z",
      lobes_header(solution, !seen.empty()));
  for (PatchId i = 0; i < solution.scene->patch_count(); ++i) {
    add_patch_values(text, solution, i, ',');
    if (!errors.empty()) {
      add_color(text, at(errors, i), ',');
    }
    add_light_and_names(text, solution, i);
    if (!solution.linear_terms.empty()) {
      add_linear_term(text, solution, i);
    }
    if (solution.glossy) {
      add_color(text, used_lobe(solution.scene->material(i)).reflectance, ',');
    }
    if (!seen.empty()) {
      add_color(text, at(seen, i), ',');
    }
    text.add("\n");
  }
}

void write_result_ply(std::ostream& out, const Solution& solution, const DisplayOptions& display) {
  const Scene& scene = *solution.scene;
  const double exposure = exposure_of(solution, display);
  TextBuffer text(out);
  text.add("ply\nformat ascii 1.0\ncomment transillum; lengths in m, E and B in W/m2\n");
  const std::vector<Rgb> seen = radiance_toward_eye(solution);
  text.add("comment colors: {} times {}, as sRGB\n", seen.empty() ? "B" : "pi L", exposure);
  text.add("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
           corner_count(scene));
  text.add("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  const bool linear = !solution.linear_terms.empty();
  if (linear) {
    text.add("property double B_r\nproperty double B_g\nproperty double B_b\n");
  }
  // Most readers support only lists whose length is a byte.
  text.add("element face {}\nproperty list {} int vertex_indices\n", scene.patch_count(),
           has_large_outlines(scene) ? "uint" : "uchar");
  text.add("property int face\nproperty int patch\n");
  for (const char* name :
       {"area", "E_r", "E_g", "E_b", "rho_r", "rho_g", "rho_b", "B_r", "B_g", "B_b"}) {
    text.add("property double {}\n", name);
  }
  for (const char* name : {"L_r", "L_g", "L_b"}) {
    if (!seen.empty()) {
      text.add("property double {}\n", name);
    }
  }
  text.add("end_header\n");
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::vector<Rgb> corners = corner_radiosity(solution, i);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3& p = scene.point(scene.outline(i)[k]);
      const Rgb color = exposure * (seen.empty() ? corners[k] : std::numbers::pi * at(seen, i));
      text.add("{} {} {} {} {} {}", p.x, p.y, p.z, srgb_byte(color.r), srgb_byte(color.g),
               srgb_byte(color.b));
      if (linear) {
        add_color(text, corners[k], ' ');
      }
      text.add("\n");
    }
  }
  std::int64_t corner = 0;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const std::size_t corners = scene.outline(i).size();
    text.add("{} ", corners);
    for (std::size_t k = 0; k < corners; ++k) {
      text.add("{} ", corner++);
    }
    add_patch_values(text, solution, i, ' ');
    if (!seen.empty()) {
      add_color(text, at(seen, i), ' ');
    }
    text.add("\n");
  }
}

}  // namespace transillum
