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
#include "visibility/fast/patch_costs.h"

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
  std::string factors = {};              ///< file of stored form factors; or empty
  bool form_factors = false;             ///< wanted in the solution, if they are kept
  bool has_series = false;               ///< a series gets the result after every iteration
  ResultSeries* series = nullptr;        ///< gets them in the first process
  int series_every = 0;                  ///< and after this many directions; 0 disables it
  CheckpointCall checkpoint = {};        ///< file and whether to resume
  double checkpoint_every = 60;          ///< s
  std::vector<std::string> shards = {};  ///< the passes are read from these
  std::optional<TotalGoal> total = {};   ///< the accuracy is a total error
  std::optional<MeasuredErrors>* errors = nullptr;  ///< gets the errors by cause, if not null
  std::optional<PatchCosts>* costs = nullptr;       ///< gets the cost of passes, if not null
  std::shared_ptr<PatchSums> sums = nullptr;        ///< sums over the passes that processes share
};

/// The total error that a run asks for, if any.
std::optional<TotalGoal> total_goal(const RunOptions& run);
/// Solves in the way that the options ask for, until it has finished or is interrupted.
/// @param checkpoint made here if the job has one.
Solution run_job(const SolveJob& job, std::optional<Checkpoint>& checkpoint);

}  // namespace transillum::cli
