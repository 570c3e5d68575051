// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How built-in scenes are shown to a user who has chosen nothing yet: by a click on their card, or
// with `--screenshot` and no other option. The faces of some scenes are so large that one radiosity
// on each does not show the light; these faces are divided, with linear functions on the patches.
#pragma once

#include <cstdint>
#include <string>

namespace transillum::viewer {

/// The approximate number of patches into which the faces of a scene are divided, each with a
/// linear function.
/// @param spec a built-in scene with its parameters, or a file
/// @returns 0 where the faces are not divided
std::int64_t soft_patches(const std::string& spec);

}  // namespace transillum::viewer
