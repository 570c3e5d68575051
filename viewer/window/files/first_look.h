// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// How scenes are shown to a user who has chosen nothing yet. The faces of some scenes are so large
// that one radiosity on each does not show the light; these faces are divided, with linear
// functions on the patches.
#pragma once

#include <string>

namespace transillum::viewer {

/// Whether a name with its parameters is the name of a built-in scene.
bool is_built_in(const std::string& spec);

/// Whether a scene is divided, if its faces are few: a file, and the built-in scenes that are about
/// light. The others are about few faces, whose light is known or that are to be counted.
/// @param spec a built-in scene with its parameters, or a file
bool has_first_look(const std::string& spec);

}  // namespace transillum::viewer
