// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <tiny_gltf.h>

#include <map>

#include "transillum/cancellation.h"

namespace transillum {

/// Vertices and triangles of a scene, each: with instances, a small file can have any number.
inline constexpr std::size_t most_gltf_elements = 20'000'000;

/// Replaces the compressed data of a file (EXT_meshopt_compression, KHR_draco_mesh_compression) by
/// buffers, views and accessors as an uncompressed file has them, of at most 1 GiB.
/// @return half a unit of each accessor whose numbers were quantized
/// @throws InputError naming the view or primitive, not the file
/// @throws Canceled
std::map<int, double> expand_gltf(tinygltf::Model& model, const Cancellation& cancellation);

}  // namespace transillum
