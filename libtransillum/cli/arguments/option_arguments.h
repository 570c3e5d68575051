// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Options of the library's table on a command line, for all programs.

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <set>
#include <string>
#include <vector>

#include "options/option_table.h"

namespace transillum::cli {

/// The options of a run, and which of them a command line has.
struct GivenOptions {
  RunOptions run;
  std::set<std::string> given;    ///< names
  std::set<std::string> offered;  ///< names of the options that it may have
};

/// Adds the options with these names. Their errors are InputError with the option's name.
/// @param options outlives the command
void add_options(CLI::App& command, GivenOptions& options,
                 std::initializer_list<std::string_view> names);
/// Adds the options of these groups of the table.
void add_sections(CLI::App& command, GivenOptions& options,
                  std::initializer_list<std::string_view> sections);
/// Sets the defaults that depend on other options, and refuses options that do nothing, or that
/// exclude each other.
/// @throws InputError
void complete(GivenOptions& options);
/// Refuses every option that is given but has no effect in any of these runs.
/// @param except an option that the command uses in another way
/// @throws InputError
void refuse_unused(const GivenOptions& options, const std::vector<RunOptions>& runs,
                   const std::string& except = {});

}  // namespace transillum::cli
