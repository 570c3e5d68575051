// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads the polygons and strips of a legacy .vtk file of VTK, ASCII or binary, versions 1 to 5:
/// rho and E as in a result, else colors.
/// @throws InputError naming the file, the line (in a binary file the byte), and what is wrong
/// @throws Canceled
SceneDescription read_vtk(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation);

}  // namespace transillum
