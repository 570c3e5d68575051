// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/build/warnings.h"
#include "scene/read/gltf/gltf_file.h"
#include "scene/read/texture_pixels.h"
#include "transillum/scene.h"

namespace transillum {

/// rho and E of a surface, what its lobe reflects, and its roughness.
struct SurfaceColors {
  Rgb reflectance, exitance, lobe;
  double roughness = 0;

  SurfaceColors& operator+=(const SurfaceColors& other);
  friend SurfaceColors operator*(double factor, const SurfaceColors& colors);
  /// The lobe; none of a rough surface that is no metal, which is diffuse.
  Lobe ggx() const;
};

/// A file's materials: rho = base color (1 - metallic), E = pi times the emissive factor and
/// strength, a lobe that reflects 0.04 (1 - metallic) + base color · metallic; each times the
/// average of its texture.
class GltfMaterials {
 public:
  /// Data of a primitive's vertices for its material.
  struct Vertices {
    std::map<int, std::vector<double>> texture_points;  ///< u, v; by set
    std::vector<double> colors;                         ///< r, g, b; empty if there are none
  };

  GltfMaterials(const GltfFile& file, const ReadOptions& options, Warnings& notes,
                const Cancellation& cancellation);

  /// Number of the material of primitives that have none.
  std::int32_t none() const { return static_cast<std::int32_t>(surfaces_.size()) - 1; }
  /// Name, as in the file or "material N".
  const std::string& name(std::int32_t material) const;
  bool is_double_sided(std::int32_t material) const;
  /// Sets of texture coordinates that a material's textures use.
  std::vector<int> texture_sets(std::int32_t material) const;
  /// Without textures and colors of vertices.
  SurfaceColors colors(std::int32_t material) const;
  /// Averaged over a triangle of these vertices.
  /// @throws Canceled
  SurfaceColors colors(std::int32_t material, const Vertices& vertices,
                       const std::array<std::uint32_t, 3>& corners);

 private:
  /// A texture of a material and how its coordinates are used.
  struct Texture {
    int image = -1, set = 0;
    bool readable = true;
    bool linear = false;
    TextureWrap across = TextureWrap::repeat, down = TextureWrap::repeat;
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    double rotation = 0;  ///< radians
  };
  struct Surface {
    std::string name;
    Rgb base{1, 1, 1};
    double metallic = 1, roughness = 1;
    Rgb exitance;
    /// The lobe's reflectance, where a file has it; else the base color gives it.
    std::optional<Rgb> specular = std::nullopt;
    bool double_sided = false, dark = false;
    std::optional<Texture> base_texture, metallic_texture, emissive_texture;
  };

  Surface surface_of(const tinygltf::Material& material, std::size_t number);
  void use_specular_glossiness(Surface& surface, const tinygltf::Material& material);
  static SurfaceColors colors_of(const Surface& surface, const Rgb& base, double metallic,
                                 double roughness, const Rgb& exitance);
  std::optional<Texture> texture_of(int index, int set, const tinygltf::ExtensionMap& extensions,
                                    bool linear);
  static void place(Texture& texture, const tinygltf::ExtensionMap& extensions);
  /// Nothing where the image cannot be read: reflectance is assumed, no metal and no light.
  std::optional<Rgb> average(const Texture& texture, const Vertices& vertices,
                             const std::array<std::uint32_t, 3>& corners);
  /// Null where the image has no pixels.
  const TexturePixels* pixels_of(const Texture& texture);
  std::string place_of(std::size_t number, const std::string& name) const;
  /// "texture 3" or "image 3", with the name of the image's file where it has one.
  std::string named(const char* what, int number, int image) const;
  void assume_unreadable(Surface& surface) const;

  const GltfFile& file_;
  const ReadOptions& options_;
  Warnings& notes_;
  const Cancellation& cancellation_;
  std::vector<Surface> surfaces_;
  /// By image and whether it is linear.
  std::map<std::pair<int, bool>, std::unique_ptr<TexturePixels>> pixels_;
  std::uint64_t pixel_count_ = 0;
};

}  // namespace transillum
