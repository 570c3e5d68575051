// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// The options of `solve`, which `merge` has in the shards that it reads.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/checkpoint_options.h"
#include "cli/arguments/color_outputs.h"
#include "cli/arguments/scene_options.h"
#include "radiosity/analysis/power_table.h"
#include "radiosity/solver/shares.h"
#include "transillum/solve_options.h"

namespace transillum::cli {

struct SolveCall {
  SceneInput scene;
  std::optional<Vec3> eye;  ///< --eye
  std::vector<std::string> out;
  std::string stats;
  std::string error_report;       ///< --error-report
  std::optional<SurfaceKind> by;  ///< --by
  std::string factors;            ///< --factors
  ColorOutputs colors;
  CheckpointCall checkpoint;
  double checkpoint_every = 60;     ///< --checkpoint-every, s
  std::optional<Share> share;       ///< --shard
  std::vector<std::string> shards;  ///< for `merge`: the passes are read from these files
  bool quiet = false;

  /// The options of the solve: as given before complete(), checked and complete after it.
  const SolveOptions& options() const { return scene.run.solve; }
};

void add_solve_options(CLI::App& command, SolveCall& call);
/// Options that say what is written, and how much memory and how many threads are used: the only
/// ones that `merge` has itself.
void add_output_options(CLI::App& command, SolveCall& call);

/// The output files, checked as far as that can be done before a long computation.
/// @throws InputError
std::vector<std::string> checked_outputs(const SolveCall& call);
/// Sets the defaults that depend on other options, and checks all.
/// @throws InputError
void complete(SolveCall& call);
/// Whether errors by cause are measured: --error-report, --total.
bool measures_errors(const SolveCall& call);
/// Checks that these errors can be measured, where they are wanted.
/// @throws InputError
void check_errors_with(const SolveCall& call, bool lobes_take_part);

/// Solves and writes the results; returns the exit status.
int run_solve(SolveCall& call);
/// Makes the passes of call.share and writes them; returns the exit status.
int run_shard(SolveCall& call);

/// The arguments that a command was given, such that they can be parsed again; without arguments
/// about runs, outputs and machines (add_output_options(), --checkpoint, --resume, --shard).
std::vector<std::string> stored_arguments(const CLI::App& command);

/// The options that a command was given, without its positional arguments.
std::vector<std::string> given_options(const CLI::App& command);

}  // namespace transillum::cli
