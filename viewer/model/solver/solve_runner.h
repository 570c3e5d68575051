// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The solver of the window: a thread that loads scenes and makes solve runs (SolveWorker).
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "model/run_options.h"
#include "model/solver/goal.h"
#include "model/solver/solve_messages.h"
#include "model/solver/solve_worker.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// Loads scenes and makes solve runs, on its own thread.
///
/// Threads: the functions and all signals belong to the thread that created it. Commands return at
/// once; a newer one replaces an older. Snapshots are immutable.
class SolveRunner : public SolveMessages {
  Q_OBJECT

 public:
  struct OpenRequest {
    std::string spec;  ///< file or built-in
    RunOptions options;
    Goal then;                ///< goal once the scene is open
    bool first_look = false;  ///< the argument of loaded_scene()
    /// A scene with the light of an earlier solve, which is shown instead of reading `spec`.
    std::shared_ptr<const LoadedScene> earlier = nullptr;
    /// Faces that were edited, instead of reading `spec`; null to read it.
    std::shared_ptr<const SceneDescription> faces = nullptr;
  };

  explicit SolveRunner(QObject* parent = nullptr);
  ~SolveRunner() override;

  /// Loads a scene; the old scene stays if loading fails or is stopped.
  void open(OpenRequest request);
  /// Solves until the goal is reached.
  void set_goal(Goal goal);
  void run() { set_goal({Goal::Kind::finished}); }
  void pause() { set_goal({Goal::Kind::pause}); }
  void advance_one_direction() { set_goal({Goal::Kind::direction}); }
  void advance_one_iteration() { set_goal({Goal::Kind::iteration}); }
  /// Cancels loading, or what comes before the first pass, which run() begins again; or discards
  /// the solve and returns to the first direction.
  void stop();
  /// Solves for other materials with the kept transfers of a glossy run, which the snapshots then
  /// have; newer ones replace these. Nothing happens in other runs.
  /// @param materials null for the materials of the scene
  void relight(std::shared_ptr<const PatchMaterials> materials);
  /// Starts a new solve run of the open scene.
  /// @param refine rounds that come first; not of a result file
  void restart(const SolveOptions& options, Goal then, const RefineChoice& refine = {}) {
    restart({options, refine}, then);
  }
  /// The same, beginning with patches that have been divided.
  void restart(SolveWorker::Choice choice, Goal then);

  /// From now on, the solve is saved to `file`: every minute, some seconds after iterations and
  /// when it pauses; with an interval of 0 after every pass. A solve that is replaced is not kept,
  /// and those with lobes are not saved. If `file` is empty, nothing is saved, and the file is
  /// removed.
  /// @param interval s
  void save_to(std::string file, double interval = 60) {
    worker_.checkpoints().save_to(std::move(file), interval);
  }
  /// The next solve continues the checkpoint in `file` if it is of the same scene and options; else
  /// it starts from the beginning. The file is then removed.
  void resume_from(std::string file) { worker_.checkpoints().resume_from(std::move(file)); }

  /// From now on, snapshots include the form factors if they fit into the memory limit.
  void include_form_factors();
  /// Whether a solve to its end shows whole pictures only: first of a draft of few directions, then
  /// of finished stages. Goals of single directions and iterations show every state.
  void set_drafts(bool drafts) { worker_.set_drafts(drafts); }
  /// The least time between two snapshots, ms.
  void set_refresh_interval(int milliseconds) { worker_.set_refresh_interval(milliseconds); }

 private:
  void replace_goal(Goal goal);
  // On the worker's thread:
  void work();
  void work_once(std::unique_lock<std::mutex>& lock);
  void load(const OpenRequest& request, const Cancellation& cancellation);

  std::mutex mutex_;  // guards all down to solve_cancellation_
  std::condition_variable wake_;
  std::optional<OpenRequest> open_request_;
  std::optional<SolveWorker::Choice> restart_request_;
  bool restart_is_older_ = false;  // than the newest open_request_, which replaces it
  std::optional<std::shared_ptr<const PatchMaterials>> relight_request_;
  bool form_factors_requested_ = false;
  Goal goal_;
  std::uint64_t goal_number_ = 0;
  bool quit_ = false;
  bool loading_ = false;
  SolveWorker::Choice choice_;       // the present or failed one
  Cancellation load_cancellation_;   // cancels the running or the last load
  Cancellation solve_cancellation_;  // cancels choice_

  SolveWorker worker_{*this};
  std::thread thread_;
};

}  // namespace transillum::viewer
