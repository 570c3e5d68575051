// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

namespace transillum::cli {

/// Checks before a long computation that each file is writable, given once and not the scene file.
/// @throws InputError
void check_output_files(const std::vector<std::string>& files, const std::string& scene);

}  // namespace transillum::cli
