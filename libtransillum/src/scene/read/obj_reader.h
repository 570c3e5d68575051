// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads an OBJ file and the MTL files it names: Kd is the reflectance, Ke the exitance. Faces
/// keep their order and all their corners; coordinates, Kd and Ke are the nearest doubles. A face's
/// group is the last `g` or `o` before it, with all names of the line. Ignored lines, what replaces
/// missing values, and other remarks are in SceneDescription::notes.
/// @param options all but the scale, which describe_scene() applies.
/// @throws InputError "file:line: …", Canceled
SceneDescription read_obj(const std::filesystem::path& path, const ReadOptions& options = {},
                          const Cancellation& cancellation = {});

}  // namespace transillum
