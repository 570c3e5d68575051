// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace transillum::cli {

/// The arguments that a command was given, such that they can be parsed again; without options for
/// runs, outputs and machines (add_output_options(), --checkpoint, --resume, --shard).
std::vector<std::string> stored_arguments(const CLI::App& command);

/// The options that a command was given, without its positional arguments.
std::vector<std::string> given_options(const CLI::App& command);

}  // namespace transillum::cli
