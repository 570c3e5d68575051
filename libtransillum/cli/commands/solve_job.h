// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/arguments/checkpoint_options.h"
#include "cli/progress_display.h"
#include "session/measure_errors.h"
#include "session/total_plan.h"
#include "transillum/cancellation.h"
#include "transillum/checkpoint.h"
#include "transillum/files.h"
#include "transillum/refinement.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum::cli {

/// The errors of a solve, and what they were measured for.
struct MeasuredErrors {
  MeasuredSolve solve;
  ErrorReport report;
  std::string total;  ///< with a total error: how its stages ended; else empty
};

/// All that any way of solving needs.
struct SolveJob {
  std::shared_ptr<const Scene> scene;
  SolveOptions options;
  std::optional<RefineOptions> refine;  ///< rounds that come first
  const Cancellation& cancellation;
  ProgressDisplay& display;
  bool quiet = false;                    ///< no line for each round
  bool form_factors = false;             ///< wanted in the solution, if they are kept
  bool has_series = false;               ///< a series gets the result after every iteration
  ResultSeries* series = nullptr;        ///< gets them in the first process
  int series_every = 0;                  ///< and after this many directions; 0 disables it
  CheckpointCall checkpoint = {};        ///< file and whether to resume
  double checkpoint_every = 60;          ///< s
  std::vector<std::string> shards = {};  ///< the passes are read from these
  std::optional<TotalGoal> total = {};   ///< the accuracy is a total error
  std::optional<MeasuredErrors>* errors = nullptr;  ///< gets the errors by cause, if not null
  std::shared_ptr<PatchSums> sums = nullptr;        ///< sums over the passes that processes share
};

/// Solves by passes, until it has finished or is interrupted.
/// @param checkpoint made here if the job has one.
Solution solve_by_passes(const SolveJob& job, std::optional<Checkpoint>& checkpoint);
/// Solves until the total error is as asked; the job has `total` and `errors`.
Solution solve_by_total(const SolveJob& job, std::optional<Checkpoint>& checkpoint);
/// Solves with the form factors in a file.
Solution solve_with_stored(const std::string& file, const SolveJob& job);
/// Solves with an engine that makes no passes.
Solution solve_without_directions(const SolveJob& job);

}  // namespace transillum::cli
