// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QElapsedTimer>
#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "model/solver/checkpoint_keeper.h"
#include "model/solver/goal.h"
#include "model/solver/scene_loading.h"
#include "model/solver/session_snapshot.h"
#include "model/solver/solve_messages.h"
#include "options/option_table.h"
#include "session/total_plan.h"
#include "transillum/cancellation.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

/// The open scene and its solve. It advances the solve toward goals and makes snapshots at
/// intervals.
///
/// Threads: interrupt(), is_preparing(), set_refresh_interval(), set_drafts(),
/// request_form_factors() and checkpoints() may be called by any thread; the others belong to one
/// thread, and may throw exceptions, which their caller has to report.
class SolveWorker {
 public:
  /// The options of a run.
  struct Choice {
    SolveOptions solve;
    RefineChoice refine = {};
    /// The patches to begin with; null for the scene as it was read.
    std::shared_ptr<const LoadedScene> from = nullptr;
    std::string division = {};  ///< name_of_division() of what is divided in `from` first, or empty
    /// The accuracy of `solve` is about all errors; refine.patches limits the patches.
    bool total = false;
  };
  /// The run of the scene as it was read.
  static Choice choice_of(const RunOptions& options) {
    return {.solve = options.solve, .refine = options.refine, .total = options.total};
  }
  /// A run that can begin.
  struct Prepared {
    Choice choice;
    std::shared_ptr<const LoadedScene> loaded;  ///< with the patches of the first round
    SolveSession session;
    Cancellation cancellation;       ///< cancels the session
    std::optional<TotalPlan> total;  ///< if chosen; the session is a stage of it
    CheckpointKeeper::Solve saved;
  };

  /// @param messages get snapshots, scenes and progress
  explicit SolveWorker(SolveMessages& messages) : messages_(messages) {}

  /// Loads a scene and prepares its solve; the open scene stays.
  /// @param spec file or built-in
  /// @param first_look  as for loaded_scene()
  /// @param runs_on  the solve is advanced to its end next
  /// @param faces  as for loaded_scene()
  /// @throws InputError, Canceled
  Prepared load(const std::string& spec, RunOptions options, bool first_look,
                const Cancellation& cancellation, bool runs_on,
                const std::shared_ptr<const SceneDescription>& faces = nullptr);
  /// Prepares a solve of a scene that was loaded before.
  /// @param preparing  checked before the first pass, in place of `cancellation`
  /// @param drafted_first  the session is not prepared where a draft comes before
  /// @throws InputError, Canceled
  Prepared prepare(const std::shared_ptr<const LoadedScene>& start, Choice choice,
                   const Cancellation& cancellation, const Cancellation& preparing,
                   bool drafted_first = false);
  /// Replaces the open scene. If its session is not prepared, it makes a draft and prepares it,
  /// until interrupt().
  void open(Prepared prepared);
  /// Replaces the solve of the open scene by a new one, whose session is canceled already.
  /// @throws InputError, Canceled: advance() then tries again; the old picture stays.
  /// @param runs_on  it is advanced to its end next: with drafts, the old picture stays until then
  void start(Choice choice, const Cancellation& cancellation, bool runs_on = false);
  /// Whether the last start() has succeeded.
  bool has_started() const { return !unstarted_; }
  /// Solves for other materials, from the present light, where lobes take part.
  /// @param materials null for the materials of the scene
  void relight(std::shared_ptr<const PatchMaterials> materials);
  /// Advances the solve until the goal is reached, or interrupt().
  void advance(const Goal& goal);
  void post_snapshot();
  /// The state between two calls.
  RunState state() const;

  /// Whether advance() pauses after the current pass. A draft, what comes before the first pass and
  /// a measurement of errors are left at once; advance() begins them again.
  void interrupt(bool interrupted = true);
  /// Whether the present work comes before the first pass of a solve.
  bool is_preparing() const { return preparing_; }
  /// The least time between two snapshots, ms.
  void set_refresh_interval(int milliseconds) { refresh_interval_ = milliseconds; }
  /// Whether a solve to its end shows whole pictures only: first of a draft of few directions.
  void set_drafts(bool drafts) { drafts_ = drafts; }
  /// From now on, snapshots include the form factors if they fit into the memory limit.
  /// @returns whether they did not before
  bool request_form_factors() { return form_factors_.request(); }
  CheckpointKeeper& checkpoints() { return checkpoints_; }

 private:
  /// The time in which is_preparing().
  class Preparing {
   public:
    explicit Preparing(SolveWorker& worker) : worker_(worker) { worker_.preparing_ = true; }
    ~Preparing() { worker_.preparing_ = false; }
    Preparing(const Preparing&) = delete;
    Preparing& operator=(const Preparing&) = delete;

   private:
    SolveWorker& worker_;
  };

  Cancellation interruption();
  void replace_session(Prepared prepared);
  void post_emission();
  SolverSnapshot snapshot_at_start(const SolveSession& other) const;
  void prepare_stage();
  std::shared_ptr<const LoadedScene> begun(const Choice& choice) const;
  void announce_patches();
  void begin_with_draft();
  bool advance_stage(const Goal& goal);
  void end_stage_of_total();
  bool observe();
  bool has_more() const;
  bool is_ready() const;
  void set_materials(SolveSession& session) const;
  void take_patches(const std::shared_ptr<const LoadedScene>& loaded);
  bool holds_patches_back() const;
  std::shared_ptr<const SolverSnapshot> make_snapshot();

  SolveMessages& messages_;
  const LoadProgress report_ = [this](const QString& phase, double fraction) {
    messages_.post_load_progress(phase, fraction);
  };
  CheckpointKeeper checkpoints_;
  KeptFormFactors form_factors_;
  std::atomic<bool> interrupted_ = false, preparing_ = false;
  std::atomic<bool> drafts_ = false;
  std::atomic<int> refresh_interval_ = 66;

  std::shared_ptr<const LoadedScene> loaded_;        // null if no scene is open
  std::shared_ptr<const PatchMaterials> materials_;  // where lobes take part; null for the
                                                     // materials of the scene
  Choice choice_;                                    // options of session_
  std::optional<SolveSession> session_;
  std::optional<Choice> unstarted_;               // to be started; session_ is canceled
  Cancellation cancellation_;                     // cancels session_ or unstarted_
  bool failed_ = false;                           // session_ cannot be continued
  std::optional<TotalPlan> total_;                // where session_ is a stage of it
  std::shared_ptr<const MeasuredErrors> errors_;  // errors of session_; null if not known
  std::mutex interruption_mutex_;                 // guards interruption_
  Cancellation interruption_;                     // cancels work other than passes
  SolveHistory history_;                          // history of the present stage
  /// The end of the last stage, if the goal has a time limit.
  std::shared_ptr<const SolverSnapshot> stage_result_;

  /// The newest whole light: of the draft, or of the last finished stage; nothing without a draft.
  std::optional<Solution> whole_;
  std::shared_ptr<const FittedLight> fitted_;  ///< null before the result

  bool patches_to_announce_ = false;  // the patches of loaded_
  QElapsedTimer since_patches_;
  QElapsedTimer since_snapshot_;
  double snapshot_cost_ms_ = 0;
};

}  // namespace transillum::viewer
