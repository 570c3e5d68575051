// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads a glTF 2.0 file, .gltf or .glb: the triangles of all meshes of its scene, placed by its
/// nodes, which are the groups. Unless ReadOptions::join is false, triangles of one plane are
/// joined (join_faces()). Materials as GltfMaterials says; a face with textures has their average
/// over it. Lengths are meters.
/// @throws InputError naming the file and what is wrong
/// @throws Canceled
SceneDescription read_gltf(const std::filesystem::path& path, const ReadOptions& options,
                           const Cancellation& cancellation);

}  // namespace transillum
