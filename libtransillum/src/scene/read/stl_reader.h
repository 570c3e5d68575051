// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads the triangles of an STL file, ASCII or binary; corners with equal coordinates are one
/// point. The solids of an ASCII file are its groups. Normals and attributes are ignored.
/// @throws InputError naming the file, the line or triangle, and what is wrong
/// @throws Canceled
SceneDescription read_stl(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation);

}  // namespace transillum
