// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Both libraries check that they read within their input and write within their output; neither
// bounds what a few bytes may ask for. meshoptimizer writes into memory of ours, whose size is
// compared with that of the input; Draco allocates what the input states, so its decoders are
// derived from to see each count before it is used (decisions/0056-readers-of-formats.md).
#include "scene/read/gltf/gltf_compression.h"

#include <draco/attributes/point_attribute.h>
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>
#include <meshoptimizer.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "base/text_file.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

/// Most bytes of output, or triangles, for a byte of input: more than either encoder achieves.
constexpr std::size_t largest_expansion = 1024;

// meshoptimizer -------------------------------------------------------------------------------

void check_view(const MeshoptView& view, std::size_t bytes) {
  const bool is_attribute = view.mode == "ATTRIBUTES";
  const bool is_index = view.mode == "TRIANGLES" || view.mode == "INDICES";
  const bool valid_stride = is_attribute
                                ? view.stride > 0 && view.stride <= 256 && view.stride % 4 == 0
                                : view.stride == 2 || view.stride == 4;
  if ((!is_attribute && !is_index) || !valid_stride ||
      (view.mode == "TRIANGLES" && view.count % 3 != 0)) {
    throw InputError(fmt::format("cannot have {} entries of {} bytes in the mode {}", view.count,
                                 view.stride, in_quotes(view.mode)));
  }
  if (view.count > largest_scene_file / view.stride ||
      view.count * view.stride / largest_expansion > bytes) {
    throw InputError(fmt::format("has {} entries of {} bytes in {} compressed bytes", view.count,
                                 view.stride, bytes));
  }
}

void apply_filter(const MeshoptView& view, std::vector<unsigned char>& data) {
  if (view.filter.empty() || view.filter == "NONE") {
    return;
  }
  if (view.mode == "ATTRIBUTES" && view.filter == "EXPONENTIAL") {
    return meshopt_decodeFilterExp(data.data(), view.count, view.stride);
  }
  if (view.mode == "ATTRIBUTES" && view.filter == "QUATERNION" && view.stride == 8) {
    return meshopt_decodeFilterQuat(data.data(), view.count, view.stride);
  }
  if (view.mode == "ATTRIBUTES" && view.filter == "OCTAHEDRAL" &&
      (view.stride == 4 || view.stride == 8)) {
    return meshopt_decodeFilterOct(data.data(), view.count, view.stride);
  }
  throw InputError(fmt::format("cannot have the filter {} on entries of {} bytes",
                               in_quotes(view.filter), view.stride));
}

// Draco ---------------------------------------------------------------------------------------

/// A decoder that refuses counts beyond its limits before anything is allocated for them.
template <class Decoder>
class Bounded : public Decoder {
 public:
  explicit Bounded(std::size_t largest_count) : largest_count_(largest_count) {}

 protected:
  /// Both encodings begin with two counts, of vertices and faces, in either order.
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    for (int k = 0; k < 2; ++k) {
      std::uint32_t count = 0;
      if (!draco::DecodeVarint(&count, &ahead) || count > largest_count_) {
        return false;
      }
    }
    return Decoder::DecodeConnectivity();
  }

  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    std::size_t entry = 0;
    for (std::int32_t a = 0; a < cloud.num_attributes(); ++a) {
      const draco::PointAttribute& of = *cloud.attribute(a);
      entry +=
          static_cast<std::size_t>(draco::DataTypeLength(of.data_type())) * of.num_components();
    }
    const std::size_t points = cloud.num_points();
    return points <= 3 * largest_count_ && entry <= largest_scene_file / (points + 1) &&
           Decoder::DecodeAllAttributes();
  }

 private:
  std::size_t largest_count_;
};

using DracoDecoder = draco::MeshDecoder;

std::unique_ptr<DracoDecoder> decoder_for(const draco::DracoHeader& header,
                                          std::size_t largest_count) {
  const bool is_mesh = header.encoder_type == draco::TRIANGULAR_MESH;
  if (!is_mesh || header.version_major != draco::kDracoMeshBitstreamVersionMajor ||
      header.version_minor != draco::kDracoMeshBitstreamVersionMinor) {
    throw InputError(
        fmt::format("is no mesh of version 2.2 of Draco's format (it is version {}.{})",
                    header.version_major, header.version_minor));
  }
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    return std::make_unique<Bounded<draco::MeshEdgebreakerDecoder>>(largest_count);
  }
  if (header.encoder_method == draco::MESH_SEQUENTIAL_ENCODING) {
    return std::make_unique<Bounded<draco::MeshSequentialDecoder>>(largest_count);
  }
  throw InputError(fmt::format("has the unknown encoding {}", header.encoder_method));
}

int component_type_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return TINYGLTF_COMPONENT_TYPE_BYTE;
    case draco::DT_UINT8:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    case draco::DT_INT16:
      return TINYGLTF_COMPONENT_TYPE_SHORT;
    case draco::DT_UINT16:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    case draco::DT_UINT32:
      return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    case draco::DT_FLOAT32:
      return TINYGLTF_COMPONENT_TYPE_FLOAT;
    case draco::DT_FLOAT64:
      return TINYGLTF_COMPONENT_TYPE_DOUBLE;
    default:
      throw InputError("has numbers of a type that glTF does not have");
  }
}

/// Half a unit of numbers that were quantized: the whole numbers are known beside them.
double half_unit(const draco::PointAttribute& numbers, const draco::PointAttribute* quantized) {
  if (quantized == nullptr || quantized->data_type() != draco::DT_INT32 ||
      numbers.data_type() != draco::DT_FLOAT32 || quantized->size() != numbers.size() ||
      quantized->num_components() != numbers.num_components()) {
    return 0;
  }
  double unit = 0;
  std::int64_t widest = 0;
  for (std::uint8_t c = 0; c < numbers.num_components(); ++c) {
    struct Entry {
      std::int32_t whole = 0;
      float number = 0;
    };
    Entry low, high;
    for (draco::AttributeValueIndex v(0); v.value() < numbers.size(); ++v) {
      Entry entry;
      std::memcpy(&entry.whole, quantized->GetAddress(v) + 4 * c, 4);
      std::memcpy(&entry.number, numbers.GetAddress(v) + 4 * c, 4);
      low = v.value() == 0 || entry.whole < low.whole ? entry : low;
      high = v.value() == 0 || entry.whole > high.whole ? entry : high;
    }
    const std::int64_t spread = std::int64_t{high.whole} - low.whole;
    if (spread > widest) {
      widest = spread;
      unit = static_cast<double>(high.number - low.number) / static_cast<double>(spread);
    }
  }
  return std::isfinite(unit) ? std::abs(unit) / 2 : 0;
}

DracoAttribute copied(const draco::PointAttribute& from, std::size_t vertices) {
  DracoAttribute to;
  to.component_type = component_type_of(from.data_type());
  to.components = from.num_components();
  const auto size =
      static_cast<std::size_t>(draco::DataTypeLength(from.data_type())) * to.components;
  to.bytes.resize(size * vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto entry = from.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(v)));
    if (entry.value() >= from.size()) {
      throw InputError(fmt::format("has no value for vertex {}", v));
    }
    std::memcpy(to.bytes.data() + size * v, from.GetAddress(entry), size);
  }
  return to;
}

}  // namespace

std::vector<unsigned char> decode_meshopt(const MeshoptView& view,
                                          std::span<const unsigned char> bytes) {
  check_view(view, bytes.size());
  std::vector<unsigned char> data(view.count * view.stride);
  const int error =
      view.count == 0             ? 0
      : view.mode == "ATTRIBUTES" ? meshopt_decodeVertexBuffer(data.data(), view.count, view.stride,
                                                               bytes.data(), bytes.size())
      : view.mode == "TRIANGLES"  ? meshopt_decodeIndexBuffer(data.data(), view.count, view.stride,
                                                              bytes.data(), bytes.size())
                                 : meshopt_decodeIndexSequence(data.data(), view.count, view.stride,
                                                               bytes.data(), bytes.size());
  if (error != 0) {
    throw InputError(fmt::format("is damaged: its {} compressed bytes are no {} entries",
                                 bytes.size(), view.count));
  }
  apply_filter(view, data);
  return data;
}

DracoMesh decode_draco(std::span<const unsigned char> bytes,
                       const std::vector<std::uint32_t>& attributes, std::size_t largest_count) {
  const auto* const data = reinterpret_cast<const char*>(bytes.data());
  draco::DecoderBuffer header_bytes, buffer;
  header_bytes.Init(data, bytes.size());
  buffer.Init(data, bytes.size());
  draco::DracoHeader header{};
  if (!draco::PointCloudDecoder::DecodeHeader(&header_bytes, &header).ok()) {
    throw InputError("is no mesh of Draco's format");
  }
  const std::size_t most = std::min(largest_count, largest_expansion * bytes.size());
  const std::unique_ptr<DracoDecoder> decoder = decoder_for(header, most);
  draco::Mesh mesh;
  if (const draco::Status status = decoder->Decode(draco::DecoderOptions(), &buffer, &mesh);
      !status.ok()) {
    throw InputError(fmt::format("is damaged, or has more than {} vertices or triangles", most));
  }
  DracoMesh decoded;
  decoded.vertices = mesh.num_points();
  for (draco::FaceIndex f(0); f.value() < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& p : mesh.face(f)) {
      decoded.indices.push_back(p.value());
    }
  }
  for (const std::uint32_t number : attributes) {
    const std::int32_t id = mesh.GetAttributeIdByUniqueId(number);
    if (id < 0) {
      throw InputError(fmt::format("has no attribute {}", number));
    }
    const draco::PointAttribute& from = *mesh.attribute(id);
    DracoAttribute& to = decoded.attributes[number] = copied(from, decoded.vertices);
    to.rounding = half_unit(from, decoder->GetPortableAttribute(id));
  }
  return decoded;
}

}  // namespace transillum
