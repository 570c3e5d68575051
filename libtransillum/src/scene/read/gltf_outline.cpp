// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The first look at a glTF file: extensions, and the places of data. tinygltf loads the buffers
// before one can ask which extensions a file requires, and takes an offset that it cannot read as
// 0; so both are read here, in a document without the file's data. Where data are compressed, what
// they replace may be missing: buffers have a length only, indices no data.
#include "scene/read/gltf_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "transillum/errors.h"

namespace transillum {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 3> lists{"extensionsRequired", "bufferViews", "accessors"};
constexpr std::array<std::string_view, 4> places{"bufferView", "buffer", "byteOffset",
                                                 "byteStride"};

template <class List>
bool contains(const List& list, const std::string& key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

/// Keeps the lists above and, of their entries, the places only.
bool is_kept(int depth, json::parse_event_t event, json& value) {
  if (event != json::parse_event_t::key || (depth != 1 && depth != 3)) {
    return true;
  }
  const auto& key = value.get_ref<const std::string&>();
  return depth == 1 ? contains(lists, key) : contains(places, key);
}

void check_places(const json& outline, const char* list, const std::string& name) {
  if (!outline.contains(list) || !outline[list].is_array()) {
    return;
  }
  for (std::size_t k = 0; k < outline[list].size(); ++k) {
    for (const auto& [key, value] : outline[list][k].items()) {
      if (!value.is_number_unsigned()) {
        throw InputError(fmt::format("{}: {} {}: {} {} is not a whole number of at least 0", name,
                                     list, k, key, value.dump().substr(0, 40)));
      }
    }
  }
}

bool has_extension(const json& object, const char* name) {
  return object.is_object() && object.contains("extensions") && object["extensions"].is_object() &&
         object["extensions"].contains(name);
}

}  // namespace

std::vector<std::string> required_extensions(std::string_view text, const std::string& name) {
  const json all = json::parse(text.begin(), text.end(), is_kept);
  std::vector<std::string> required;
  if (!all.is_object()) {
    return required;
  }
  check_places(all, "bufferViews", name);
  check_places(all, "accessors", name);
  if (all.contains("extensionsRequired")) {
    for (const json& extension : all["extensionsRequired"]) {
      required.push_back(extension.is_string() ? extension.get<std::string>() : "");
    }
  }
  return required;
}

bool is_compressed_gltf(std::string_view text) {
  return text.find(meshopt_extension) != std::string_view::npos ||
         text.find(draco_extension) != std::string_view::npos;
}

std::string parsable_gltf(std::string_view text) {
  json all = json::parse(text);
  for (json& buffer : all["buffers"]) {
    if (has_extension(buffer, meshopt_extension) && !buffer.contains("uri")) {
      buffer["uri"] = "data:application/octet-stream;base64,AA==";
      buffer["byteLength"] = 1;
    }
  }
  for (json& mesh : all["meshes"]) {
    for (json& primitive : mesh["primitives"]) {
      if (has_extension(primitive, draco_extension)) {
        primitive.erase("indices");
      }
    }
  }
  return all.dump();
}

}  // namespace transillum
