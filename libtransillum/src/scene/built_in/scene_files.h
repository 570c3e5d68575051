// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/scene.h"

namespace transillum {

/// Reads a file whose name ends as one of scene_formats(), and joins its faces as `options` say.
/// @throws InputError, Canceled
SceneDescription read_scene_file(const std::string& path, const ReadOptions& options,
                                 const Cancellation& cancellation);

}  // namespace transillum
