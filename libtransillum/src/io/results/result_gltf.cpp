// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Results as glTF 2.0, for Blender and viewers on the web: triangles with a linear color per corner
// (COLOR_0), or with a light map and its coordinates (TEXCOORD_0), and a material without lighting
// (KHR_materials_unlit), a node per group. Input: the convex pieces of the patches.
#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "base/base64.h"
#include "io/png_text.h"
#include "io/results/result_writers.h"
#include "io/srgb.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/picture.h"

namespace transillum {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the format (glTF 2.0, sections 3.6 and 5).
constexpr int type_float = 5126, type_uint = 5125, array_buffer = 34962, index_buffer = 34963;
constexpr int filter_linear = 9729, clamp_to_edge = 33071;
constexpr std::size_t largest_buffer = std::size_t{1} << 31;

/// Three floats.
using Triple = std::array<float, 3>;

/// The triangles of a group.
struct Triangles {
  std::vector<Triple> positions, colors;             ///< colors: empty with a light map
  std::vector<std::array<float, 2>> texture_points;  ///< in the light map
  std::vector<std::uint32_t> indices;
};

Triple triple(const Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// The format demands colors from 0 to 1.
Triple color_of(const Rgb& b, double exposure) {
  const auto channel = [&](double value) {
    return static_cast<float>(std::clamp(exposure * value, 0.0, 1.0));
  };
  return {channel(b.r), channel(b.g), channel(b.b)};
}

class PatchColors {
 public:
  PatchColors(const Solution& solution, PatchId i, double exposure)
      : mean_(at(solution.radiosity, i)), exposure_(exposure) {
    if (!solution.linear_terms.empty()) {
      term_ = at(solution.linear_terms, i);
      basis_ = linear_basis(*solution.scene, i);
    }
  }
  Triple at_point(const Vec3& point) const {
    if (!basis_) {
      return color_of(mean_, exposure_);
    }
    const auto [first, second] = basis_->at(point);
    return color_of(mean_ + first * term_.first + second * term_.second, exposure_);
  }

 private:
  Rgb mean_;
  double exposure_;
  LinearTerm term_;
  std::optional<LinearBasis> basis_;  ///< nothing: B is constant on patches
};

/// Texture coordinates of a point of a patch.
using TexturePlace = std::function<std::array<float, 2>(PatchId, const Vec3&)>;

std::array<float, 2> place_in(const LightMap& map, PatchId i, const Vec3& point) {
  const auto [x, y] = map.place(i, point);
  return {static_cast<float>(x / map.width()), static_cast<float>(y / map.height())};
}

std::string png_of_map(const LightMap& map, double exposure) {
  std::vector<unsigned char> bytes;
  bytes.reserve(3 * map.radiosity().size());
  for (const auto& b : map.radiosity()) {
    for (const float channel : b) {
      bytes.push_back(
          static_cast<unsigned char>(srgb_byte(exposure * static_cast<double>(channel))));
    }
  }
  return png_of(map.width(), map.height(), bytes);
}

/// Triangles by group, with coordinates relative to `origin`: floats have few digits.
/// @param place coordinates in a light map; empty: colors of corners
std::map<std::int32_t, Triangles> triangles_of(const Solution& solution, double exposure,
                                               const TexturePlace& place, const Vec3& origin) {
  const Scene& scene = *solution.scene;
  std::map<std::int32_t, Triangles> groups;
  for (const Piece& piece : scene.pieces()) {
    Triangles& group = groups[scene.patch(piece.patch).group];
    const auto corners = scene.corners(piece);
    const auto first = static_cast<std::uint32_t>(group.positions.size());
    const PatchColors colors(solution, piece.patch, exposure);
    for (const PointId corner : corners) {
      group.positions.push_back(triple(scene.point(corner) - origin));
      if (place) {
        group.texture_points.push_back(place(piece.patch, scene.point(corner)));
      } else {
        group.colors.push_back(colors.at_point(scene.point(corner)));
      }
    }
    for (std::uint32_t k = 1; k + 1 < corners.size(); ++k) {
      group.indices.insert(group.indices.end(), {first, first + k, first + k + 1});
    }
  }
  return groups;
}

/// The rotation, as a quaternion x, y, z, w, that turns the unit vector `up` to +y.
std::array<double, 4> rotation_to_y(const Vec3& up) {
  if (up.y < -1 + 1e-12) {
    return {1, 0, 0, 0};  // half a turn about x
  }
  const Vec3 axis = cross(up, {0, 1, 0});
  const double w = 1 + up.y;
  const double length = std::sqrt(dot(axis, axis) + w * w);
  return {axis.x / length, axis.y / length, axis.z / length, w / length};
}

/// The document and its buffer, under construction.
class GltfDocument {
 public:
  explicit GltfDocument(const Solution& solution, const DisplayOptions& display) {
    const Scene& scene = *solution.scene;
    const double exposure = exposure_of(solution, display);
    const Vec3 origin = scene.bounds().center();
    json_["asset"] = {{"version", "2.0"}, {"generator", "transillum " TRANSILLUM_VERSION}};
    json_["extensionsUsed"] = {"KHR_materials_unlit"};
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", {0}}, {"extras", {{"exposure", exposure}}}}};
    Json root = {{"name", scene.name()}, {"children", Json::array()}};
    // The rotation applies before the translation.
    if (display.up) {
      root["rotation"] = rotation_to_y(*display.up);
    }
    json_["nodes"].push_back(root);
    json_["materials"] = {
        {{"name", "radiosity"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
         {"extensions", {{"KHR_materials_unlit", Json::object()}}}}};
    std::shared_ptr<const LightMap> map = display.light_map ? display.sharp_map : nullptr;
    if (display.light_map && !map) {
      map = std::make_shared<const LightMap>(solution);
    }
    TexturePlace place;
    if (map) {
      place = [&](PatchId i, const Vec3& point) { return place_in(*map, i, point); };
    }
    for (const auto& [group, triangles] : triangles_of(solution, exposure, place, origin)) {
      add_mesh(group == no_group ? scene.name() : at(scene.groups(), group), triangles, origin);
    }
    if (map) {
      add_texture(png_of_map(*map, exposure));
    }
  }

  /// The document with a buffer at `uri`; without one, the buffer follows it in a binary file.
  std::string text(const std::string& uri = {}) {
    Json buffer = {{"byteLength", buffer_.size()}};
    if (!uri.empty()) {
      buffer["uri"] = uri;
    }
    json_["buffers"] = nlohmann::json::array({buffer});
    return json_.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  const std::string& buffer() const { return buffer_; }

 private:
  void add_mesh(const std::string& name, const Triangles& triangles, const Vec3& origin) {
    Triple low = triangles.positions.front(), high = low;
    for (const Triple& p : triangles.positions) {
      for (std::size_t k = 0; k < p.size(); ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
      }
    }
    const int position = add_accessor(triangles.positions, type_float, "VEC3", array_buffer);
    json_["accessors"].back()["min"] = low;
    json_["accessors"].back()["max"] = high;
    Json attributes = {{"POSITION", position}};
    if (triangles.texture_points.empty()) {
      attributes["COLOR_0"] = add_accessor(triangles.colors, type_float, "VEC3", array_buffer);
    } else {
      attributes["TEXCOORD_0"] =
          add_accessor(triangles.texture_points, type_float, "VEC2", array_buffer);
    }
    const int indices = add_accessor(triangles.indices, type_uint, "SCALAR", index_buffer);
    json_["meshes"].push_back(
        {{"name", name},
         {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}});
    Json& nodes = json_["nodes"];
    nodes[0]["children"].push_back(nodes.size());
    nodes.push_back({{"name", name},
                     {"mesh", json_["meshes"].size() - 1},
                     {"translation", {origin.x, origin.y, origin.z}}});
  }

  /// The picture of a texture, without reductions: they would mix the colors of patches.
  void add_texture(const std::string& png) {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", png.size()}});
    json_["images"] = {{{"name", "light map"},
                        {"mimeType", "image/png"},
                        {"bufferView", json_["bufferViews"].size() - 1}}};
    json_["samplers"] = {{{"magFilter", filter_linear},
                          {"minFilter", filter_linear},
                          {"wrapS", clamp_to_edge},
                          {"wrapT", clamp_to_edge}}};
    json_["textures"] = {{{"sampler", 0}, {"source", 0}}};
    json_["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0},
                                                                         {"texCoord", 0}};
    buffer_ += png;
    buffer_.append((4 - buffer_.size() % 4) % 4, '\0');
  }

  template <class Value>
  int add_accessor(const std::vector<Value>& values, int type, const char* shape, int target) {
    const std::size_t size = values.size() * sizeof(Value);
    if (buffer_.size() + size > largest_buffer) {
      throw InputError("the result is too large for a glTF file: more than 2 GiB of triangles");
    }
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}, {"target", target}});
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", type},
                                  {"count", values.size()},
                                  {"type", shape}});
    buffer_.append(reinterpret_cast<const char*>(values.data()), size);
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  Json json_;
  std::string buffer_;  ///< whole words of 4 bytes
};

void write_word(std::ostream& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  char bytes[4];
  std::memcpy(bytes, &word, sizeof word);
  out.write(bytes, sizeof bytes);
}

void write_chunk(std::ostream& out, const char* type, const std::string& bytes) {
  write_word(out, bytes.size());
  out.write(type, 4);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

void write_result_glb(std::ostream& out, const Solution& solution, const DisplayOptions& display) {
  GltfDocument document(solution, display);
  std::string json = document.text();
  json.append((4 - json.size() % 4) % 4, ' ');
  constexpr std::size_t head = 12, chunk_head = 8;
  out.write("glTF", 4);
  write_word(out, 2);
  write_word(out, head + 2 * chunk_head + json.size() + document.buffer().size());
  write_chunk(out, "JSON", json);
  write_chunk(out, "BIN\0", document.buffer());
}

void write_result_gltf(std::ostream& out, const Solution& solution, const DisplayOptions& display) {
  GltfDocument document(solution, display);
  out << document.text("data:application/octet-stream;base64," + to_base64(document.buffer()))
      << '\n';
}

}  // namespace transillum
