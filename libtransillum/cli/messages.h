// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::cli {

/// One line on stderr, whatever control characters `text` holds.
void print_message(const std::string& text);
/// What was mended in the scene, a line a warning.
void print_warnings(const Scene& scene);
/// `, did you mean "..."?` where one of the choices is nearly `word`, else nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& choices);

}  // namespace transillum::cli
