// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads the polygons of a Radiance scene description (.rad), which are groups by their names.
/// plastic, metal and trans: rho = color (1 - specularity); light, glow, illum and spotlight: E =
/// pi times their radiance. Other surfaces and lights are omitted and noted.
/// @throws InputError naming the file, the line and what is wrong; for commands (`!`), which are
/// not run
/// @throws Canceled
SceneDescription read_radiance(const std::filesystem::path& path, const ReadOptions& options,
                               const Cancellation& cancellation);

}  // namespace transillum
