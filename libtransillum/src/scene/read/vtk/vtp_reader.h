// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads the polygons and strips of a .vtp file of VTK: rho and E as in a result, else colors.
/// @throws InputError naming the file, the polygon or array, and what is wrong
/// @throws Canceled
SceneDescription read_vtp(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation);

}  // namespace transillum
