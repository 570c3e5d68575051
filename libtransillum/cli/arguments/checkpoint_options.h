// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace transillum::cli {

/// --checkpoint and --resume.
struct CheckpointCall {
  std::string file;     ///< empty: nothing is saved
  bool resume = false;  ///< resume the run in the file, if it is there
};

/// @param help what --checkpoint does
/// @returns the option --checkpoint
CLI::Option* add_checkpoint_options(CLI::App& command, CheckpointCall& call,
                                    const std::string& help);
/// Refuses to overwrite what a run has saved.
/// @throws InputError
void check_checkpoint(const CheckpointCall& call);
/// Whether there is a run to resume; prints that there is none, where --resume was given.
bool can_resume(const CheckpointCall& call);

}  // namespace transillum::cli
