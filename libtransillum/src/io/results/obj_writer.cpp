// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <ostream>
#include <set>
#include <stdexcept>

#include "transillum/files.h"

namespace transillum {
namespace {

/// Formats into a block of memory, since streams are slow on small pieces.
class Text {
 public:
  explicit Text(std::ostream& stream) : stream_(stream) {}
  ~Text() { flush(); }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  template <typename... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(block_), format, std::forward<Values>(values)...);
    constexpr std::size_t full = 1 << 16;
    if (block_.size() >= full) {
      flush();
    }
  }

 private:
  void flush() {
    stream_.write(block_.data(), static_cast<std::streamsize>(block_.size()));
    block_.clear();
  }
  std::ostream& stream_;
  fmt::memory_buffer block_;
};

/// Names that survive a line of text each and differ from one another.
std::vector<std::string> written_names(const std::vector<Material>& materials) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const Material& m : materials) {
    std::string name = m.name;
    for (char& c : name) {
      if (static_cast<unsigned char>(c) < ' ') {
        c = '_';
      }
    }
    // Blanks at the ends would be lost, and a backslash there would join two lines.
    if (name.empty() || name.front() == ' ') {
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

void write_materials(std::ostream& stream, const std::vector<Material>& materials,
                     const std::vector<std::string>& names) {
  Text text(stream);
  text.add("# Kd: reflectance; Ke: emitted exitance, W/m2\n");
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const Rgb& rho = materials[m].reflectance;
    const Rgb& e = materials[m].exitance;
    text.add("newmtl {}\nKd {} {} {}\nKe {} {} {}\n", names[m], rho.r, rho.g, rho.b, e.r, e.g, e.b);
  }
}

void write_faces(std::ostream& stream, const SceneDescription& description,
                 const std::string& library, const std::vector<std::string>& names) {
  Text text(stream);
  text.add("# {} vertices, {} faces; meters\n", description.points.size(),
           description.face_count());
  if (!names.empty()) {
    text.add("mtllib {}\n", library);
  }
  for (const Vec3& p : description.points) {
    text.add("v {} {} {}\n", p.x, p.y, p.z);
  }
  std::int32_t in_use = -1;
  for (std::size_t f = 0; f < description.face_count(); ++f) {
    const std::int32_t material = description.face_material[f];
    if (material != in_use) {
      text.add("usemtl {}\n", names.at(static_cast<std::size_t>(material)));
    }
    in_use = material;
    text.add("f");
    for (const PointId p : description.outline(f)) {
      text.add(" {}", p + 1);
    }
    text.add("\n");
  }
}

}  // namespace

void write_obj(const std::filesystem::path& path, const SceneDescription& description) {
  const std::vector<std::string> names = written_names(description.materials);
  const std::filesystem::path library = std::filesystem::path(path).replace_extension(".mtl");
  write_file_whole(path, [&](std::ostream& stream) {
    write_faces(stream, description, library.filename().string(), names);
    // Both or neither: the MTL takes its place when all of the OBJ is on the disk, and the OBJ
    // right after.
    if (!stream.flush()) {
      throw std::runtime_error(path.string() + ": cannot be written");
    }
    write_file_whole(library, [&](std::ostream& materials) {
      write_materials(materials, description.materials, names);
    });
  });
}

}  // namespace transillum
