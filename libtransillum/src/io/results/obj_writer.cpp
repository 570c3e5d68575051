// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Writes a scene description as OBJ with MTL, so that the OBJ reader gets back the same
// description.
#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <set>

#include "base/text_file.h"
#include "io/text.h"
#include "transillum/at.h"
#include "transillum/files.h"

namespace transillum {
namespace {

/// Names changed so that each fits on a line of text and no two are equal, nor equal to one of
/// `taken`.
std::vector<std::string> written_names(const std::vector<std::string>& given,
                                       std::set<std::string> taken = {}) {
  std::vector<std::string> names;
  for (std::string name : given) {
    for (char& c : name) {
      if (static_cast<unsigned char>(c) < ' ') {
        c = '_';
      }
    }
    // A reader drops blanks and quotes at the ends, and a backslash at the end joins two lines.
    if (name.empty() || name.front() == ' ' || unquoted(name) != name) {
      name.insert(name.begin(), '_');
    }
    if (name.back() == ' ' || name.back() == '\\') {
      name += '_';
    }
    std::string unique = name;
    for (int i = 2; !taken.insert(unique).second; ++i) {
      unique = fmt::format("{}-{}", name, i);
    }
    names.push_back(unique);
  }
  return names;
}

std::vector<std::string> written_names(const std::vector<Material>& materials) {
  std::vector<std::string> names;
  for (const Material& m : materials) {
    names.push_back(m.name);
  }
  return written_names(names);
}

void write_materials(std::ostream& stream, const std::vector<Material>& materials,
                     const std::vector<std::string>& names) {
  TextBuffer text(stream);
  const bool lobes = std::any_of(materials.begin(), materials.end(),
                                 [](const Material& material) { return material.lobe.present(); });
  text.add("# Kd: reflectance; Ke: emitted exitance, W/m2{}\n",
           lobes ? "; Ks: reflectance of a lobe, Ns: its exponent, Pr: its roughness" : "");
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const Rgb& rho = materials[m].reflectance;
    const Rgb& e = materials[m].exitance;
    text.add("newmtl {}\nKd {} {} {}\nKe {} {} {}\n", names[m], rho.r, rho.g, rho.b, e.r, e.g, e.b);
    const Lobe& lobe = materials[m].lobe;
    if (lobe.present()) {
      const Rgb& fraction = lobe.reflectance;
      text.add("Ks {} {} {}\n", fraction.r, fraction.g, fraction.b);
      const bool phong = lobe.shape == LobeShape::phong;
      text.add("{} {}\n", phong ? "Ns" : "Pr", phong ? lobe.exponent : lobe.roughness);
    }
  }
}

template <class Corner>
void add_outline(TextBuffer& text, Corner corner, Corner end) {
  text.add("f");
  for (; corner != end; ++corner) {
    text.add(" {}", *corner + 1);
  }
  text.add("\n");
}

void write_faces(std::ostream& stream, const SceneDescription& description,
                 const std::string& library, const std::vector<std::string>& names) {
  TextBuffer text(stream);
  text.add("# {} vertices, {} faces; meters\n", description.points.size(),
           description.face_count());
  if (!names.empty()) {
    text.add("mtllib {}\n", library);
  }
  for (const Vec3& p : description.points) {
    text.add("v {} {} {}\n", p.x, p.y, p.z);
  }
  // The name of faces without a group.
  constexpr const char* no_group_name = "default";
  const std::vector<std::string> groups = written_names(description.groups, {no_group_name});
  std::int32_t current = -1, current_group = no_group;
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const std::int32_t group = description.group_of(f);
    if (group != current_group) {
      text.add("g {}\n", group == no_group ? no_group_name : at(groups, group));
    }
    current_group = group;
    const std::int32_t material = description.face_material[f];
    if (material != current) {
      text.add("usemtl {}\n", names.at(static_cast<std::size_t>(material)));
    }
    current = material;
    const auto outline = description.outline(f);
    add_outline(text, outline.begin(), outline.end());
    if (description.is_two_sided(f)) {
      add_outline(text, outline.rbegin(), outline.rend());
    }
  }
}

}  // namespace

std::filesystem::path materials_file_of(const std::filesystem::path& obj) {
  return std::filesystem::path(obj).replace_extension(".mtl");
}

void write_obj(const std::filesystem::path& path, const SceneDescription& description) {
  const std::vector<std::string> names = written_names(description.materials);
  const std::filesystem::path library = materials_file_of(path);
  check_distinct({path.string(), library.string()}, description.files);
  write_file_whole(path, [&](std::ostream& stream) {
    write_faces(stream, description, library.filename().string(), names);
    // Both or neither: the MTL is renamed into place after all of the OBJ is written, and the OBJ
    // directly after it.
    if (!stream.flush()) {
      return;  // the caller reports the reason
    }
    write_file_whole(library, [&](std::ostream& materials) {
      write_materials(materials, description.materials, names);
    });
  });
}

}  // namespace transillum
