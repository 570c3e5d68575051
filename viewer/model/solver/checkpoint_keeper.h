// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

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

  /// Continues the solve in the file of resume_from(), if there is one, and removes it. If the file
  /// is from another solve, the session starts from the beginning; the file then stays for a later
  /// round, if there is one.
  /// @param session has made no pass
  /// @param options of its solves
  /// @throws Canceled; as SolveSession::prepare()
  void resume(SolveSession& session, const SolveOptions& options);
  /// To be called when another solve begins; the previous one is no longer saved.
  /// @param options of the solve
  void begin(std::shared_ptr<const Scene> scene, const SolveOptions& options);
  /// To be called after each pass and iteration, and in pauses: saves when the interval has passed;
  /// after an iteration and in a pause, when a twelfth of it has passed.
  void save_if_due(const SolveSession& session, bool in_pause = false);

 private:
  std::mutex mutex_;         ///< guards all below
  std::string resume_from_;  ///< checkpoint of another program; empty if there is none
  std::string file_;
  double interval_ = 60;
  std::shared_ptr<const Scene> scene_;
  SolveOptions options_;
  std::chrono::steady_clock::time_point since_;
  std::optional<Checkpoint> checkpoint_;  ///< made when it is first saved: that takes a while
};

}  // namespace transillum::viewer
