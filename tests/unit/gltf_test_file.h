// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// glTF files for tests: their content is added piece by piece, and written as .glb or .gltf.

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace transillum::test {

/// A glTF file with one buffer.
class GltfText {
 public:
  nlohmann::json root = {{"asset", {{"version", "2.0"}}},
                         {"scene", 0},
                         {"scenes", {{{"nodes", nlohmann::json::array()}}}},
                         {"nodes", nlohmann::json::array()},
                         {"meshes", nlohmann::json::array()},
                         {"accessors", nlohmann::json::array()},
                         {"bufferViews", nlohmann::json::array()},
                         {"materials", nlohmann::json::array()}};
  std::string bytes;
  /// Length of a second buffer without data, as files with compressed views have it; 0 if there is
  /// none.
  std::size_t placeholder = 0;

  /// Returns the number of the view.
  template <class Number>
  int view(const std::vector<Number>& numbers, int stride = 0) {
    bytes.resize((bytes.size() + 7) / 8 * 8);
    nlohmann::json added = {{"buffer", 0},
                            {"byteOffset", bytes.size()},
                            {"byteLength", numbers.size() * sizeof(Number)}};
    if (stride > 0) {
      added["byteStride"] = stride;
    }
    const std::size_t begin = bytes.size();
    bytes.resize(begin + numbers.size() * sizeof(Number));
    std::memcpy(bytes.data() + begin, numbers.data(), numbers.size() * sizeof(Number));
    root["bufferViews"].push_back(added);
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }
  int accessor(int view, int component, const char* type, std::size_t count) {
    root["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}});
    return static_cast<int>(root["accessors"].size()) - 1;
  }
  int points(const std::vector<float>& xyz) {
    return accessor(view(xyz), 5126, "VEC3", xyz.size() / 3);
  }
  int indices(const std::vector<std::uint16_t>& all) {
    return accessor(view(all), 5123, "SCALAR", all.size());
  }
  /// Adds a mesh with one primitive and a root node that has it.
  nlohmann::json& add(const nlohmann::json& primitive,
                      const nlohmann::json& node = nlohmann::json::object()) {
    root["meshes"].push_back({{"primitives", {primitive}}});
    nlohmann::json added = node;
    added["mesh"] = root["meshes"].size() - 1;
    root["nodes"].push_back(added);
    root["scenes"][0]["nodes"].push_back(root["nodes"].size() - 1);
    return root["nodes"].back();
  }

  std::string glb() const {
    nlohmann::json whole = root;
    whole["buffers"] = {{{"byteLength", bytes.size()}}};
    add_placeholder(whole);
    std::string text = whole.dump(), data = bytes;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string file = "glTF";
    const auto word = [&](std::size_t w) {
      for (int k = 0; k < 4; ++k) {
        file += static_cast<char>(w >> (8 * k));
      }
    };
    word(2);
    word(12 + 8 + text.size() + 8 + data.size());
    word(text.size());
    file += "JSON" + text;
    word(data.size());
    file += std::string("BIN\0", 4) + data;
    return file;
  }
  std::string gltf(const std::string& uri) const {
    nlohmann::json whole = root;
    whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", uri}}};
    add_placeholder(whole);
    return whole.dump(1);
  }

 private:
  void add_placeholder(nlohmann::json& whole) const {
    if (placeholder > 0) {
      whole["buffers"].push_back(
          {{"byteLength", placeholder},
           {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    }
  }
};

inline const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
inline const std::vector<std::uint16_t> two_triangles{0, 1, 2, 0, 2, 3};

/// A square in the plane z = 0 that faces up.
inline nlohmann::json square_in(GltfText& file, int material = -1) {
  nlohmann::json primitive = {{"attributes", {{"POSITION", file.points(square)}}},
                              {"indices", file.indices(two_triangles)}};
  if (material >= 0) {
    primitive["material"] = material;
  }
  return primitive;
}

}  // namespace transillum::test
