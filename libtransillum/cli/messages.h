// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/scene.h"

namespace transillum::cli {

/// One line on stderr, whatever control characters `text` holds.
void print_message(const std::string& text);
/// What was mended in the scene, a line a warning.
void print_warnings(const Scene& scene);

}  // namespace transillum::cli
