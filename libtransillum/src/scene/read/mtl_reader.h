// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/build/warnings.h"
#include "scene/read/file_search.h"
#include "scene/read/texture_average.h"
#include "transillum/scene.h"

namespace transillum {

/// The materials of one or more MTL files. The first definition of a name is used.
class MaterialLibrary {
 public:
  /// @param files finds textures; it must live as long as the library.
  explicit MaterialLibrary(FileSearch& files) : search_(files) {}

  /// Adds the materials of a file, and remarks about it to `notes`. Definitions without a name are
  /// omitted.
  /// @throws InputError "file:line: …"
  void read(const std::filesystem::path& path, Warnings& notes, const Cancellation& cancellation);

  const std::vector<Material>& materials() const { return materials_; }
  /// Moves materials() out; find() remains valid.
  std::vector<Material> take_materials() { return std::move(materials_); }
  /// Index in materials(), or -1: the name as spelled, else without regard to case.
  std::int32_t find(const std::string& name) const;
  std::vector<std::string> names() const;
  /// Makes a material that faces use usable: the average of its texture where only that has a
  /// color, and reflectances below 1. To be called once for each.
  /// @throws InputError for values that nothing can replace
  /// @throws Canceled
  void complete(std::size_t material, const ReadOptions& options, Warnings& notes,
                const Cancellation& cancellation);
  /// Images read by complete().
  const std::vector<std::string>& textures() const { return textures_; }

 private:
  struct Place {
    std::size_t file;
    std::int32_t line;
    std::string texture;  ///< map_Kd as written, where Kd is 0 or missing
  };
  void add(Material material, Place place, bool has_reflectance, Warnings& notes);
  void replace_by_texture(Material& material, const Place& place, const ReadOptions& options,
                          Warnings& notes, const Cancellation& cancellation);
  TextureAverage average(const Place& place, const Cancellation& cancellation);
  void lower_reflectance(Material& material, const Place& place, const ReadOptions& options,
                         Warnings& notes) const;
  std::string text_of(const Place& place) const;

  FileSearch& search_;
  std::vector<std::string> files_;
  std::vector<Material> materials_;
  std::vector<Place> places_;
  std::map<std::string, std::int32_t> numbers_;
  std::map<std::string, std::int32_t> lower_case_numbers_;
  std::map<std::filesystem::path, TextureAverage> averages_;
  std::vector<std::string> textures_;
};

}  // namespace transillum
