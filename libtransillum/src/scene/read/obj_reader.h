// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads an OBJ file and the MTL files it names: Kd is the reflectance, Ke the exitance. Faces
/// keep their order and all their corners; coordinates, Kd and Ke are the nearest doubles. Ignored
/// lines and other remarks are in SceneDescription::notes.
/// @throws InputError "file:line: …", Canceled
SceneDescription read_obj(const std::filesystem::path& path, const Cancellation& cancellation = {});

}  // namespace transillum
