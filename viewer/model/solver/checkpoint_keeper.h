// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "session/total_plan.h"
#include "transillum/checkpoint.h"

namespace transillum::viewer {

/// Saves the solve that runs, so that another program can continue it after a crash. Errors are
/// ignored: a full disk must not interrupt the user every minute.
///
/// Threads: save_to() and resume_from() may be called by any thread; the others belong to the
/// worker's thread.
class CheckpointKeeper {
 public:
  ~CheckpointKeeper() { save_to({}); }

  /// Saves the solve in `file` from now on; nothing is saved if `file` is empty. The previous file
  /// is removed.
  /// @param interval s
  void save_to(std::string file, double interval = 60);
  /// The next solve continues the checkpoint in `file`, if that is of the same scene and options.
  void resume_from(std::string file);

  /// A solve, by what its file is recognized.
  struct Solve {
    std::shared_ptr<const Scene> scene;  ///< scene of the first stage; nothing is saved without one
    SolveOptions options;
    bool total = false;  ///< whether the accuracy of `options` is about all errors
  };

  /// Continues the solve in the file of resume_from(), if there is one, and removes it. If the file
  /// is from another solve, the session starts from the beginning; the file then stays for a later
  /// round, if there is one.
  /// @param session has made no pass
  /// @throws Canceled; as SolveSession::prepare()
  void resume(SolveSession& session, const Solve& solve);
  /// Sets a new plan to the stage in the file of resume_from(), which resume() then continues.
  /// @returns whether there is one; if not, the plan may not be used
  /// @throws Canceled
  bool restore(TotalPlan& plan, const Solve& solve, const Cancellation& cancellation);
  /// To be called when another solve begins; the previous one is no longer saved.
  void begin(Solve solve);
  /// To be called when a stage of a solve to a total error begins. What is saved of the stage
  /// before stays until the new one is saved.
  void begin_stage(const TotalPlan& plan);
  /// To be called after each pass and iteration, and in pauses: saves when the interval has passed;
  /// after an iteration and in a pause, when a twelfth of it has passed.
  void save_if_due(const SolveSession& session, bool in_pause = false);

 private:
  std::mutex mutex_;         ///< guards all below
  std::string resume_from_;  ///< checkpoint of another program; empty if there is none
  std::string file_;
  double interval_ = 60;
  Solve solve_;
  std::string plan_;  ///< state of the TotalPlan; empty without one
  std::chrono::steady_clock::time_point since_;
  std::optional<Checkpoint> checkpoint_;  ///< made when it is first saved: that takes a while
};

}  // namespace transillum::viewer
