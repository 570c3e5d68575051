// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Compressed meshes of glTF files: decoders whose time and memory are bounded whatever the bytes
// are. Extensions EXT_meshopt_compression and KHR_draco_mesh_compression.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace transillum {

/// Description of a view compressed by meshoptimizer.
struct MeshoptView {
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};

/// Decodes a view: count x stride bytes.
/// @throws InputError without a place, as "has 3 entries of 300 bytes …"
std::vector<unsigned char> decode_meshopt(const MeshoptView& view,
                                          std::span<const unsigned char> bytes);

/// The data of a vertex attribute of a mesh compressed by Draco.
struct DracoAttribute {
  int component_type = 0;  ///< component type, as of accessors
  std::size_t components = 0;
  std::vector<unsigned char> bytes;
  double rounding = 0;  ///< half a unit of quantized numbers; 0 if not quantized
};

struct DracoMesh {
  std::size_t vertices = 0;
  std::vector<std::uint32_t> indices;  ///< three for each triangle
  std::map<std::uint32_t, DracoAttribute> attributes;
};

/// Decodes a mesh and the attributes that have these numbers.
/// @param largest_count of vertices and of triangles
/// @throws InputError without a place
DracoMesh decode_draco(std::span<const unsigned char> bytes,
                       const std::vector<std::uint32_t>& attributes, std::size_t largest_count);

}  // namespace transillum
