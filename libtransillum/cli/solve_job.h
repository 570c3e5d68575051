// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>

#include "progress_display.h"
#include "solve_call.h"
#include "transillum/cancellation.h"
#include "transillum/checkpoint.h"
#include "transillum/files.h"
#include "transillum/radiosity.h"

namespace transillum::cli {

/// What all ways of solving need.
struct SolveJob {
  std::shared_ptr<const Scene> scene;
  SolveOptions options;
  const Cancellation& cancellation;
  ProgressDisplay& display;
  bool form_factors = false;                     ///< wanted in the solution, if they are kept
  bool has_series = false;                       ///< a series gets the result after every iteration
  ResultSeries* series = nullptr;                ///< it, in the first process
  int series_every = 0;                          ///< and after so many directions; 0: not
  Checkpoint* checkpoint = nullptr;              ///< null: the solve is not kept
  double checkpoint_every = 60;                  ///< s
  bool resume = false;                           ///< go on with what is in the checkpoint
  std::vector<std::string> shards = {};          ///< the passes are read from these
  std::shared_ptr<SolverGroup> group = nullptr;  ///< processes that share the passes
};

/// Solves by passes, until it has finished or is interrupted.
Solution solve_by_passes(const SolveJob& job);
/// Solves with lobes.
Solution solve_with_lobes(const SolveJob& job);
/// Solves with the form factors in a file.
Solution solve_with_stored(const std::string& file, const SolveJob& job);
/// Solves with an engine that makes no passes.
Solution solve_without_directions(const SolveJob& job);

}  // namespace transillum::cli
