// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Materials of glTF describe more than diffuse surfaces and lobes. Omissions are noted: what a
// diffuse solve omits of a metal, and what is transparent.
#include "scene/read/gltf/gltf_materials.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/text_file.h"
#include "geometry/luminance.h"
#include "scene/read/texture_average.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Limit for all decoded textures together; 12 bytes each.
constexpr std::uint64_t most_decoded_pixels = std::uint64_t{1} << 27;

Rgb color_of(const std::vector<double>& factors, const Rgb& otherwise) {
  return factors.size() < 3 ? otherwise : Rgb{factors[0], factors[1], factors[2]};
}

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

double number_of(const tinygltf::Value& object, const char* key, double otherwise) {
  return object.Has(key) && object.Get(key).IsNumber() ? object.Get(key).GetNumberAsDouble()
                                                       : otherwise;
}

std::vector<double> numbers_of(const tinygltf::Value& object, const char* key) {
  std::vector<double> numbers;
  if (object.Has(key)) {
    const tinygltf::Value& list = object.Get(key);
    for (std::size_t k = 0; k < list.ArrayLen(); ++k) {
      const tinygltf::Value& number = list.Get(static_cast<int>(k));
      numbers.push_back(number.IsNumber() ? number.GetNumberAsDouble() : 0.0);
    }
  }
  return numbers;
}

/// The image of a texture in a format that an extension adds, as KHR_texture_basisu; or -1.
int image_of(const tinygltf::Texture& texture) {
  for (const auto& [name, extension] : texture.extensions) {
    if (extension.IsObject() && extension.Has("source")) {
      return static_cast<int>(number_of(extension, "source", -1));
    }
  }
  return -1;
}

TextureWrap wrap_of(int mode) {
  return mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? TextureWrap::clamp
         : mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::mirror
                                                         : TextureWrap::repeat;
}

/// Share that non-metals reflect at their surface, without its entering (glTF 2.0, appendix B).
constexpr double dielectric_fraction = 0.04;
/// A smoother surface is a mirror, which no set of directions resolves.
constexpr double least_roughness = 0.01;

}  // namespace

SurfaceColors& SurfaceColors::operator+=(const SurfaceColors& other) {
  reflectance += other.reflectance;
  exitance += other.exitance;
  lobe += other.lobe;
  roughness += other.roughness;
  return *this;
}

SurfaceColors operator*(double factor, const SurfaceColors& colors) {
  return {factor * colors.reflectance, factor * colors.exitance, factor * colors.lobe,
          factor * colors.roughness};
}

Lobe SurfaceColors::ggx() const {
  constexpr double nearly = 1 - 1e-9;  // means of textures are rounded
  if (roughness >= nearly && max_abs(lobe) <= dielectric_fraction) {
    return {};
  }
  Lobe lobe_of{.reflectance = lobe, .shape = LobeShape::ggx};
  lobe_of.roughness = std::min(roughness, 1.0);
  return lobe_of;
}

GltfMaterials::GltfMaterials(const GltfFile& file, const ReadOptions& options, Warnings& notes,
                             const Cancellation& cancellation)
    : file_(file), options_(options), notes_(notes), cancellation_(cancellation) {
  const std::vector<tinygltf::Material>& materials = file_.model().materials;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    surfaces_.push_back(surface_of(materials[m], m));
  }
  const double rho = options_.default_reflectance;
  Surface none;
  none.name = "no-material";
  none.base = {rho, rho, rho};
  none.metallic = 0;
  surfaces_.push_back(none);
}

const std::string& GltfMaterials::name(std::int32_t material) const {
  return at(surfaces_, material).name;
}

bool GltfMaterials::is_double_sided(std::int32_t material) const {
  return at(surfaces_, material).double_sided;
}

std::vector<int> GltfMaterials::texture_sets(std::int32_t material) const {
  const Surface& surface = at(surfaces_, material);
  std::vector<int> sets;
  for (const auto* texture :
       {&surface.base_texture, &surface.metallic_texture, &surface.emissive_texture}) {
    if (*texture) {
      sets.push_back((*texture)->set);
    }
  }
  return sets;
}

GltfMaterials::Surface GltfMaterials::surface_of(const tinygltf::Material& material,
                                                 std::size_t number) {
  const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
  Surface surface;
  surface.name = material.name.empty() ? fmt::format("material {}", number) : material.name;
  surface.double_sided = material.doubleSided;
  surface.base = color_of(pbr.baseColorFactor, {1, 1, 1});
  surface.metallic = pbr.metallicFactor;
  surface.roughness = pbr.roughnessFactor;
  surface.base_texture = texture_of(pbr.baseColorTexture.index, pbr.baseColorTexture.texCoord,
                                    pbr.baseColorTexture.extensions, false);
  surface.metallic_texture =
      texture_of(pbr.metallicRoughnessTexture.index, pbr.metallicRoughnessTexture.texCoord,
                 pbr.metallicRoughnessTexture.extensions, true);
  surface.emissive_texture =
      texture_of(material.emissiveTexture.index, material.emissiveTexture.texCoord,
                 material.emissiveTexture.extensions, false);
  use_specular_glossiness(surface, material);
  assume_unreadable(surface);

  double strength = 1;
  if (const auto* e = extension_of(material.extensions, "KHR_materials_emissive_strength")) {
    strength = number_of(*e, "emissiveStrength", 1);
  }
  strength = surface.dark ? 0 : strength;
  surface.exitance = std::numbers::pi * strength / (options_.photometric ? lumens_per_watt : 1) *
                     color_of(material.emissiveFactor, {});
  const std::string place = place_of(number, surface.name);
  if (!(surface.roughness >= 0 && surface.roughness <= 1)) {
    surface.roughness = surface.roughness > 0 ? 1 : 0;  // diffuse solves do not need it
  }
  for (const double v : {surface.base.r, surface.base.g, surface.base.b, surface.metallic}) {
    if (!(v >= 0 && v <= 1)) {
      file_.fail(fmt::format("{}: a color factor of {} is not in the range 0 to 1", place, v));
    }
  }
  if (surface.metallic == 1 && !surface.metallic_texture && !(max_abs(surface.base) == 0)) {
    notes_.add("materials that are metals",
               fmt::format("{}: {} is a metal (metallic factor 1), which has no diffuse "
                           "reflectance; rho = 0, all that it reflects is its lobe",
                           file_.files().front(), place));
  }
  if (material.alphaMode == "BLEND" || material.extensions.contains("KHR_materials_transmission")) {
    notes_.add(
        "transparent materials, taken as opaque",
        fmt::format("{}: {} is transparent; it is taken as opaque", file_.files().front(), place));
  }
  return surface;
}

/// The older description of materials, where a file has it.
void GltfMaterials::use_specular_glossiness(Surface& surface, const tinygltf::Material& material) {
  const auto* older = extension_of(material.extensions, "KHR_materials_pbrSpecularGlossiness");
  if (older == nullptr) {
    return;
  }
  surface.base = color_of(numbers_of(*older, "diffuseFactor"), {1, 1, 1});
  surface.metallic = 0;
  surface.roughness = 1 - number_of(*older, "glossinessFactor", 1);
  surface.specular = color_of(numbers_of(*older, "specularFactor"), {1, 1, 1});
  surface.metallic_texture.reset();
  surface.base_texture.reset();
  if (older->Has("diffuseTexture") && older->Get("diffuseTexture").IsObject()) {
    const tinygltf::Value& texture = older->Get("diffuseTexture");
    tinygltf::ExtensionMap extensions;
    if (texture.Has("extensions") && texture.Get("extensions").Has("KHR_texture_transform")) {
      extensions["KHR_texture_transform"] = texture.Get("extensions").Get("KHR_texture_transform");
    }
    surface.base_texture =
        texture_of(static_cast<int>(number_of(texture, "index", -1)),
                   static_cast<int>(number_of(texture, "texCoord", 0)), extensions, false);
  }
}

std::optional<GltfMaterials::Texture> GltfMaterials::texture_of(
    int index, int set, const tinygltf::ExtensionMap& extensions, bool linear) {
  const tinygltf::Model& model = file_.model();
  if (index < 0) {
    return {};
  }
  if (static_cast<std::size_t>(index) >= model.textures.size()) {
    file_.fail(
        fmt::format("texture {} does not exist; there are {}", index, model.textures.size()));
  }
  const tinygltf::Texture& from = at(model.textures, index);
  Texture texture;
  texture.image = from.source;
  texture.set = set;
  texture.linear = linear;
  if (texture.image < 0 || static_cast<std::size_t>(texture.image) >= model.images.size()) {
    texture.readable = false;
    notes_.add("textures without a readable image",
               fmt::format("{}: {} is no PNG or JPEG image; reflectance {} is assumed for it",
                           file_.files().front(), named("texture", index, image_of(from)),
                           options_.default_reflectance));
    return texture;
  }
  if (from.sampler >= 0 && static_cast<std::size_t>(from.sampler) < model.samplers.size()) {
    texture.across = wrap_of(at(model.samplers, from.sampler).wrapS);
    texture.down = wrap_of(at(model.samplers, from.sampler).wrapT);
  }
  place(texture, extensions);
  return texture;
}

void GltfMaterials::place(Texture& texture, const tinygltf::ExtensionMap& extensions) {
  const auto* transform = extension_of(extensions, "KHR_texture_transform");
  if (transform == nullptr) {
    return;
  }
  const std::vector<double> offset = numbers_of(*transform, "offset");
  const std::vector<double> scale = numbers_of(*transform, "scale");
  if (offset.size() == 2) {
    texture.offset = {offset[0], offset[1]};
  }
  if (scale.size() == 2) {
    texture.scale = {scale[0], scale[1]};
  }
  texture.rotation = number_of(*transform, "rotation", 0);
  texture.set = static_cast<int>(number_of(*transform, "texCoord", texture.set));
}

SurfaceColors GltfMaterials::colors(std::int32_t material) const {
  const Surface& surface = at(surfaces_, material);
  return colors_of(surface, surface.base, surface.metallic, surface.roughness, surface.exitance);
}

SurfaceColors GltfMaterials::colors_of(const Surface& surface, const Rgb& base, double metallic,
                                       double roughness, const Rgb& exitance) {
  const double plain = dielectric_fraction * (1 - metallic);
  const Rgb lobe = surface.specular.value_or(Rgb{plain, plain, plain} + metallic * base);
  return {(1 - metallic) * base,
          exitance,
          {std::max(lobe.r, 0.0), std::max(lobe.g, 0.0), std::max(lobe.b, 0.0)},
          std::max(roughness, least_roughness)};
}

SurfaceColors GltfMaterials::colors(std::int32_t material, const Vertices& vertices,
                                    const std::array<std::uint32_t, 3>& corners) {
  const Surface& surface = at(surfaces_, material);
  Rgb base = surface.base, exitance = surface.exitance;
  double metallic = surface.metallic, roughness = surface.roughness;
  if (surface.base_texture) {
    const double otherwise = options_.default_reflectance;
    base = base * average(*surface.base_texture, vertices, corners)
                      .value_or(Rgb{otherwise, otherwise, otherwise});
  }
  if (surface.metallic_texture) {
    const Rgb factors =
        average(*surface.metallic_texture, vertices, corners).value_or(Rgb{1, 1, 0});
    metallic *= factors.b;
    roughness *= factors.g;
  }
  if (surface.emissive_texture) {
    exitance = exitance * average(*surface.emissive_texture, vertices, corners).value_or(Rgb{});
  }
  if (!vertices.colors.empty()) {
    Rgb sum;
    for (const std::uint32_t c : corners) {
      const double* color = vertices.colors.data() + 3 * std::size_t{c};
      sum += {color[0], color[1], color[2]};
    }
    base = base * (1.0 / 3 * sum);
  }
  return colors_of(surface, base, metallic, roughness, exitance);
}

std::optional<Rgb> GltfMaterials::average(const Texture& texture, const Vertices& vertices,
                                          const std::array<std::uint32_t, 3>& corners) {
  const TexturePixels* pixels = pixels_of(texture);
  if (pixels == nullptr) {
    return {};
  }
  const auto points = vertices.texture_points.find(texture.set);
  if (points == vertices.texture_points.end()) {
    return Rgb{1, 1, 1};
  }
  std::array<TexturePoint, 3> triangle;
  const double cosine = std::cos(texture.rotation), sine = std::sin(texture.rotation);
  for (std::size_t k = 0; k < 3; ++k) {
    const double* point = points->second.data() + 2 * std::size_t{corners[k]};
    const double u = texture.scale[0] * point[0], v = texture.scale[1] * point[1];
    triangle[k] = {texture.offset[0] + cosine * u + sine * v,
                   texture.offset[1] - sine * u + cosine * v};
  }
  return pixels->average(triangle, texture.across, texture.down);
}

const TexturePixels* GltfMaterials::pixels_of(const Texture& texture) {
  auto& pixels = pixels_[{texture.image, texture.linear}];
  if (!pixels) {
    const auto image = static_cast<std::size_t>(texture.image);
    std::string problem = "is beyond the limit of pixels";
    if (pixel_count_ < most_decoded_pixels) {
      pixels =
          std::make_unique<TexturePixels>(file_.image_bytes(image), texture.linear, cancellation_);
      problem = pixels->problem();
      pixel_count_ += pixels->size();
    } else {
      pixels =
          std::make_unique<TexturePixels>(std::span<const unsigned char>(), false, cancellation_);
    }
    if (!problem.empty()) {
      notes_.add("images that cannot be read",
                 fmt::format("{}: {} {}; reflectance {} is assumed for it, and no light",
                             file_.files().front(), named("image", texture.image, texture.image),
                             problem, options_.default_reflectance));
    }
  }
  return pixels->problem().empty() ? pixels.get() : nullptr;
}

/// A base color is the default reflectance then; nothing is metal, and nothing emits.
void GltfMaterials::assume_unreadable(Surface& surface) const {
  const auto drop = [](std::optional<Texture>& texture) {
    const bool unreadable = texture && !texture->readable;
    if (unreadable) {
      texture.reset();
    }
    return unreadable;
  };
  if (drop(surface.base_texture)) {
    surface.base = options_.default_reflectance * surface.base;
  }
  if (drop(surface.metallic_texture)) {
    surface.metallic = 0;
  }
  surface.dark = drop(surface.emissive_texture);
}

std::string GltfMaterials::named(const char* what, int number, int image) const {
  const std::vector<tinygltf::Image>& images = file_.model().images;
  if (image < 0 || static_cast<std::size_t>(image) >= images.size()) {
    return fmt::format("{} {}", what, number);
  }
  const tinygltf::Image& of = at(images, image);
  const std::string& name = of.uri.empty() ? of.name : of.uri;
  return name.empty() ? fmt::format("{} {}", what, number)
                      : fmt::format("{} {}, {},", what, number, in_quotes(name));
}

std::string GltfMaterials::place_of(std::size_t number, const std::string& name) const {
  return fmt::format("material {}, {}", number, in_quotes(name));
}

}  // namespace transillum
