// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "command_model.h"

namespace transillum::manual {

/// The file that bash-completion loads for a program; it needs nothing but bash.
std::string bash_completion(const Program& program);
/// The function _NAME of zsh.
std::string zsh_completion(const Program& program);
/// The file that fish loads for a program.
std::string fish_completion(const Program& program);

/// The beginning of a description, for menus: one line of at most 72 characters.
std::string short_text(const std::string& description);
/// The program's name in names of shell functions.
std::string function_name(const Program& program);
/// Names of the built-in scenes.
std::vector<std::string> scene_names();
/// Endings of what a program opens as SCENE, as ".obj".
std::vector<std::string> scene_endings(const Program& program);

}  // namespace transillum::manual
