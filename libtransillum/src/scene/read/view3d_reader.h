// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads the vertices and surfaces of a View3D file (.vs3, geometry 3). A surface with emissivity e
/// has rho = 1 - e; obstructions have rho = 0. Subsurfaces are cut out of their base; Patch::face
/// counts surfaces in the order of the file. Combined surfaces are one group; others have a group
/// each, with the surface's name.
/// @throws InputError naming the file, the line and what is wrong
/// @throws Canceled
SceneDescription read_view3d(const std::filesystem::path& path, const ReadOptions& options,
                             const Cancellation& cancellation);

}  // namespace transillum
