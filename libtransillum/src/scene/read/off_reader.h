// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads the polygons of an ASCII OFF file, also with normals and colors of vertices, which are
/// ignored. Colors of faces are the reflectance: whole numbers of 0 to 255 by the transfer function
/// of sRGB, fractions as they are.
/// @throws InputError naming the file, the line and what is wrong
/// @throws Canceled
SceneDescription read_off(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation);

}  // namespace transillum
