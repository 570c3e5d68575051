// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// The options of `solve`, which `merge` has in the shards that it reads.

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "checkpoint_options.h"
#include "color_outputs.h"
#include "scene_options.h"
#include "sequence_options.h"
#include "transillum/power_table.h"
#include "transillum/radiosity.h"
#include "transillum/refinement.h"
#include "transillum/shares.h"

namespace transillum::cli {

struct SolveCall {
  const CLI::App* command = nullptr;
  SceneInput scene;
  SequenceOptions sequence;
  SolveOptions options;
  bool one_way = false, two_way = false;
  bool stop_given = false;  ///< --iterations or --tolerance
  bool shot_given = false;  ///< --first-shot
  bool diffuse_only = false;
  std::optional<Vec3> eye;  ///< --eye
  std::vector<std::string> out;
  std::string stats;
  std::optional<PartsBy> by;          ///< --by
  std::string factors;                ///< --factors
  std::optional<RefineBy> refine_by;  ///< --refine-by, until scene.patches are made
  double refine_until = 0;            ///< --refine-until
  ColorOutputs colors;
  CheckpointCall checkpoint;
  double checkpoint_every = 60;     ///< --checkpoint-every, s
  std::optional<Share> share;       ///< --shard
  std::vector<std::string> shards;  ///< of `merge`: the passes are read from these
  bool quiet = false;
};

/// All options of `solve`.
void add_solve_options(CLI::App& command, SolveCall& call);
/// Those that say what is written, and how much memory and how many threads are used: the only ones
/// that `merge` has itself.
void add_output_options(CLI::App& command, SolveCall& call);

/// The output files, checked as far as that can be done before a long computation.
/// @throws InputError
std::vector<std::string> checked_outputs(const SolveCall& call);
/// The options of the solve run, checked.
/// @throws InputError
SolveOptions solve_options(const SolveCall& call);

/// Solves and writes the results; returns the exit status.
int run_solve(const SolveCall& call);
/// Makes the passes of call.share and writes them; returns the exit status.
int run_shard(const SolveCall& call);

}  // namespace transillum::cli
