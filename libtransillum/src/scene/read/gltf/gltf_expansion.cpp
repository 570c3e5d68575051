// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Where the compressed data of a glTF file are, and where they go. gltf_compression.h decodes them.
#include "scene/read/gltf/gltf_expansion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text_file.h"
#include "scene/read/gltf/gltf_compression.h"
#include "scene/read/gltf/gltf_outline.h"
#include "transillum/at.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// A whole number of an extension, at least 0 and at most 2^53.
std::size_t whole_number(const tinygltf::Value& object, const std::string& key,
                         std::size_t otherwise) {
  if (!object.Has(key)) {
    return otherwise;
  }
  const tinygltf::Value& value = object.Get(key);
  const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1;
  if (!(number >= 0 && number <= 0x1p53 && number == std::floor(number))) {
    throw InputError(fmt::format("{} is not a whole number of at least 0", key));
  }
  return static_cast<std::size_t>(number);
}

std::string text_of(const tinygltf::Value& object, const std::string& key) {
  return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

class Expansion {
 public:
  Expansion(tinygltf::Model& model, const Cancellation& cancellation)
      : model_(model), cancellation_(cancellation) {}

  std::map<int, double> run() {
    for (std::size_t v = 0; v < model_.bufferViews.size(); ++v) {
      const auto found = model_.bufferViews[v].extensions.find(meshopt_extension);
      if (found != model_.bufferViews[v].extensions.end()) {
        expand(fmt::format("buffer view {}", v),
               [&] { expand_view(model_.bufferViews[v], tinygltf::Value(found->second)); });
      }
    }
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
      for (tinygltf::Primitive& primitive : model_.meshes[m].primitives) {
        const auto found = primitive.extensions.find(draco_extension);
        if (found != primitive.extensions.end()) {
          expand(fmt::format("mesh {}", m), [&] { expand_primitive(primitive, found->second); });
        }
      }
    }
    return std::move(rounding_);
  }

 private:
  template <class Action>
  void expand(const std::string& place, Action action) {
    cancellation_.throw_if_canceled();
    try {
      action();
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: its compressed data: {}", place, error.what()));
    }
  }

  std::span<const unsigned char> bytes_at(std::size_t buffer, std::size_t offset,
                                          std::size_t size) const {
    if (buffer >= model_.buffers.size()) {
      throw InputError(
          fmt::format("buffer {} does not exist; there are {}", buffer, model_.buffers.size()));
    }
    const std::vector<unsigned char>& data = model_.buffers[buffer].data;
    if (offset > data.size() || size > data.size() - offset) {
      throw InputError(fmt::format("buffer {} has no {} bytes from byte {}; it has {}", buffer,
                                   size, offset, data.size()));
    }
    return std::span(data).subspan(offset, size);
  }

  /// Adds a buffer; returns its number.
  int add_buffer(std::vector<unsigned char> data) {
    bytes_ += data.size();
    if (bytes_ > largest_scene_file) {
      throw InputError(
          fmt::format("with those before, they are more than {} bytes", largest_scene_file));
    }
    model_.buffers.emplace_back().data = std::move(data);
    return static_cast<int>(model_.buffers.size()) - 1;
  }

  void expand_view(tinygltf::BufferView& view, const tinygltf::Value& stated) {
    const MeshoptView of{whole_number(stated, "count", 0), whole_number(stated, "byteStride", 0),
                         text_of(stated, "mode"), text_of(stated, "filter")};
    std::vector<unsigned char> data = decode_meshopt(
        of, bytes_at(whole_number(stated, "buffer", model_.buffers.size()),
                     whole_number(stated, "byteOffset", 0), whole_number(stated, "byteLength", 0)));
    view.byteOffset = 0;
    view.byteLength = data.size();
    view.buffer = add_buffer(std::move(data));
  }

  /// An accessor of data of its own; returns its number.
  int add_accessor(std::vector<unsigned char> data, std::size_t count, int component, int type,
                   bool normalized) {
    tinygltf::BufferView view;
    view.byteLength = data.size();
    view.buffer = add_buffer(std::move(data));
    model_.bufferViews.push_back(std::move(view));
    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = count;
    accessor.normalized = normalized;
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  void expand_primitive(tinygltf::Primitive& primitive, const tinygltf::Value& stated) {
    const std::size_t view = whole_number(stated, "bufferView", model_.bufferViews.size());
    if (view >= model_.bufferViews.size()) {
      throw InputError(fmt::format("buffer view {} does not exist; there are {}", view,
                                   model_.bufferViews.size()));
    }
    // Names of those that are read, and their numbers in the compressed mesh.
    std::map<std::string, std::uint32_t> numbers;
    if (stated.Has("attributes") && stated.Get("attributes").IsObject()) {
      for (const auto& [name, number] : stated.Get("attributes").Get<tinygltf::Value::Object>()) {
        if (name == "POSITION" || name == "COLOR_0" || name.starts_with("TEXCOORD_")) {
          numbers[name] = static_cast<std::uint32_t>(
              std::min<std::size_t>(whole_number(stated.Get("attributes"), name, 0), 0xffffffff));
        }
      }
    }
    Mesh& mesh = meshes_[{view, numbers}];
    if (mesh.indices < 0) {
      decode(mesh, view, numbers, primitive);
    }
    primitive.indices = mesh.indices;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    for (const auto& [name, accessor] : mesh.accessors) {
      primitive.attributes[name] = accessor;
    }
  }

  struct Mesh {
    int indices = -1;
    std::map<std::string, int> accessors;
  };

  void decode(Mesh& mesh, std::size_t view, const std::map<std::string, std::uint32_t>& numbers,
              const tinygltf::Primitive& primitive) {
    std::vector<std::uint32_t> wanted;
    for (const auto& [name, number] : numbers) {
      wanted.push_back(number);
    }
    const tinygltf::BufferView& from = model_.bufferViews[view];
    const auto buffer =
        from.buffer < 0 ? model_.buffers.size() : static_cast<std::size_t>(from.buffer);
    const auto compressed = bytes_at(buffer, from.byteOffset, from.byteLength);
    read_ += compressed.size();
    if (read_ > 4 * largest_scene_file) {
      throw InputError("is decoded too often");
    }
    DracoMesh decoded = decode_draco(compressed, wanted, most_gltf_elements - elements_);
    elements_ += std::max(decoded.vertices, decoded.indices.size() / 3);
    for (const auto& [name, number] : numbers) {
      DracoAttribute& attribute = decoded.attributes[number];
      const int component = attribute.component_type;
      const int accessor =
          add_accessor(attribute.bytes, decoded.vertices, component, type_of(attribute.components),
                       is_normalized(primitive, name));
      mesh.accessors[name] = accessor;
      if (attribute.rounding > 0) {
        rounding_[accessor] = attribute.rounding;
      }
    }
    const auto* const bytes = reinterpret_cast<const unsigned char*>(decoded.indices.data());
    mesh.indices = add_accessor({bytes, bytes + 4 * decoded.indices.size()}, decoded.indices.size(),
                                TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, false);
  }

  static int type_of(std::size_t components) {
    constexpr std::array<int, 4> types{TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                                       TINYGLTF_TYPE_VEC4};
    if (components < 1 || components > types.size()) {
      throw InputError(fmt::format("an attribute has {} numbers per entry", components));
    }
    return types[components - 1];
  }

  /// Whether the accessor that the file has in place of the compressed data is normalized.
  bool is_normalized(const tinygltf::Primitive& primitive, const std::string& name) const {
    const auto found = primitive.attributes.find(name);
    return found != primitive.attributes.end() && found->second >= 0 &&
           static_cast<std::size_t>(found->second) < model_.accessors.size() &&
           at(model_.accessors, found->second).normalized;
  }

  tinygltf::Model& model_;
  const Cancellation& cancellation_;
  std::map<int, double> rounding_;
  std::map<std::pair<std::size_t, std::map<std::string, std::uint32_t>>, Mesh> meshes_;
  std::size_t bytes_ = 0;     ///< decoded so far
  std::size_t read_ = 0;      ///< by Draco so far
  std::size_t elements_ = 0;  ///< decoded by Draco so far
};

}  // namespace

std::map<int, double> expand_gltf(tinygltf::Model& model, const Cancellation& cancellation) {
  return Expansion(model, cancellation).run();
}

}  // namespace transillum
