// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/build/warnings.h"
#include "transillum/scene.h"

namespace transillum {

/// The materials of one or more MTL files. Of several with one name the first counts.
class MaterialLibrary {
 public:
  /// @throws InputError "file:line: …"
  void read(const std::filesystem::path& path, Warnings& notes, const Cancellation& cancellation);

  const std::vector<Material>& materials() const { return materials_; }
  /// "file:line: " of the definition.
  const std::string& place(std::size_t material) const { return places_[material]; }
  /// -1 where there is none of that name.
  std::int32_t find(const std::string& name) const;
  std::vector<std::string> names() const;

 private:
  std::vector<Material> materials_;
  std::vector<std::string> places_;
  std::map<std::string, std::int32_t> numbers_;
};

}  // namespace transillum
