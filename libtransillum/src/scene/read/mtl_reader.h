// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/build/warnings.h"
#include "transillum/scene.h"

namespace transillum {

/// The materials of one or more MTL files. The first definition of a name is used.
class MaterialLibrary {
 public:
  /// Adds the materials of a file, and remarks about it to `notes`.
  /// @throws InputError "file:line: …"
  void read(const std::filesystem::path& path, Warnings& notes, const Cancellation& cancellation);

  const std::vector<Material>& materials() const { return materials_; }
  /// Moves materials() out; find() remains valid.
  std::vector<Material> take_materials() { return std::move(materials_); }
  /// "file:line: " of the definition, for messages.
  std::string place(std::size_t material) const { return text_of(places_[material]); }
  /// Index in materials(), or -1.
  std::int32_t find(const std::string& name) const;
  std::vector<std::string> names() const;

 private:
  struct Place {
    std::size_t file;
    std::int32_t line;
  };
  void add(Material material, std::int32_t line, bool has_reflectance, Warnings& notes);
  std::string text_of(const Place& place) const;

  std::vector<std::string> files_;
  std::vector<Material> materials_;
  std::vector<Place> places_;
  std::map<std::string, std::int32_t> numbers_;
};

}  // namespace transillum
