// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How built-in scenes are shown to somebody who has chosen nothing yet: by a click on their card,
// or with `--screenshot` and no other option. The faces of some are so large that one radiosity on
// each does not show light; these are divided, with linear functions on the patches.
#pragma once

#include <cstdint>
#include <string>

namespace transillum::viewer {

/// Into about how many patches the faces of a scene are divided, each with a linear function.
/// @param spec a built-in scene with its parameters, or a file
/// @returns 0 where the faces are taken as they are
std::int64_t soft_patches(const std::string& spec);

}  // namespace transillum::viewer
