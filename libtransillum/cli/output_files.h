// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

namespace transillum::cli {

/// Before long work: each file can be written, none is named twice, none is the scene itself.
/// @throws InputError
void check_output_files(const std::vector<std::string>& files, const std::string& scene);

}  // namespace transillum::cli
