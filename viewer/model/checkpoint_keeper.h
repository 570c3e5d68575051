// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "transillum/checkpoint.h"

namespace transillum::viewer {

/// Removes a file at the end of its life.
class RemovedAtEnd {
 public:
  explicit RemovedAtEnd(std::string file) : file_(std::move(file)) {}
  ~RemovedAtEnd() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  RemovedAtEnd(const RemovedAtEnd&) = delete;
  RemovedAtEnd& operator=(const RemovedAtEnd&) = delete;
  /// It is not removed.
  void keep() { file_.clear(); }

 private:
  std::string file_;
};

/// Keeps the solve that runs in a file, so that another program can go on with it after a crash.
/// Errors are ignored: a full disk must not interrupt the user every minute.
///
/// Threads: set_file() may be called by any thread; the others belong to the solver's.
class CheckpointKeeper {
 public:
  ~CheckpointKeeper() { set_file({}); }

  /// Where the solve is kept from now on; empty: nowhere. The file before is removed.
  /// @param interval s
  void set_file(std::string file, double interval = 60);
  /// Another solve begins; the one before is no longer kept.
  /// @param options of the solve
  void begin(std::shared_ptr<const Scene> scene, const SolveOptions& options);
  /// To be called after each pass and iteration: saves when the interval has passed, after an
  /// iteration a twelfth of it.
  void save_if_due(const RadiositySolver& solver, const AccuracyPlan* plan);
  /// To be called when the solver pauses.
  void save_soon(const RadiositySolver& solver, const AccuracyPlan* plan);

 private:
  void save(const RadiositySolver& solver, const AccuracyPlan* plan, bool soon);

  std::mutex mutex_;  ///< guards all below
  std::string file_;
  double interval_ = 60;
  std::shared_ptr<const Scene> scene_;
  SolveOptions options_;
  std::chrono::steady_clock::time_point since_;
  std::optional<Checkpoint> checkpoint_;  ///< made when it is first saved: that takes a while
};

}  // namespace transillum::viewer
