// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace transillum::cli {

/// Whether an output is standard output: its name is `-`.
bool is_standard_output(const std::string& name);

/// The files that have a name and are not standard output.
std::vector<std::string> given_files(std::vector<std::string> files);

/// Checks before a long computation that each file is writable and given once.
/// @throws InputError
void check_output_files(const std::vector<std::string>& files);

/// Runs all of these, even if some fail, then rethrows the first error: results that took long are
/// not lost because one of several files cannot be written. A pipe without a reader comes last.
void write_all(const std::vector<std::function<void()>>& writers);

}  // namespace transillum::cli
