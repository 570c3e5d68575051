// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The solver of the window: loads scenes, makes solve runs on a worker thread, and posts snapshots.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "model/checkpoint_keeper.h"
#include "model/run_options.h"
#include "model/running_solver.h"
#include "model/snapshot.h"
#include "transillum/accuracy_plan.h"
#include "transillum/cancellation.h"
#include "transillum/refinement.h"

namespace transillum::viewer {

/// What the solver is to reach before it pauses. With rounds of refinement: `finished` and `passes`
/// are about the solve after the last round.
struct Goal {
  enum class Kind { pause, direction, iteration, passes, finished };
  Kind kind = Kind::pause;
  std::int64_t passes = 0;  ///< for Kind::passes: passes_done() of the solve
};

/// Loads scenes and makes solve runs, on its own thread.
///
/// Threads: the public functions and all signals belong to the thread that created it. Commands
/// return at once; a newer one replaces an older. Snapshots are immutable; one that has not been
/// delivered yet is replaced by its successor.
class SolveRunner : public QObject {
  Q_OBJECT

 public:
  struct OpenRequest {
    std::string spec;  ///< file or built-in
    RunOptions options;
    Goal then;  ///< goal once the scene is open
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
  /// Cancels loading; or discards the solve and returns to the first direction.
  void stop();
  /// Solves for other materials with the kept transfers of a glossy run, which the snapshots then
  /// have; newer ones replace these. Nothing happens in other runs.
  /// @param materials null: those of the scene
  void relight(std::shared_ptr<const PatchMaterials> materials);
  /// Starts a new solve run of the open scene.
  /// @param refine rounds that come first; not of a result file
  void restart(const SolveOptions& options, Goal then, const RefineChoice& refine = {});

  /// From now on, the solve is kept in `file`: every minute, some seconds after iterations and when
  /// it pauses; with an interval of 0 after every pass. Of a solve that is replaced, nothing is
  /// kept, nor of glossy ones. Empty: nothing is kept, and the file is removed.
  /// @param interval s
  void keep_in(std::string file, double interval = 60);
  /// The next solve goes on with the checkpoint in `file`, if that is of the same scene and
  /// options; else it begins at its beginning. The file is removed then.
  void go_on_with(std::string file);

  /// From now on, snapshots include the form factors if they fit into the memory limit.
  void include_form_factors();

  RunState state() const { return state_; }
  /// The least time between two snapshots, ms.
  void set_refresh_interval(int milliseconds) { refresh_interval_ = milliseconds; }

 signals:
  void state_changed(transillum::viewer::RunState state);
  void scene_loaded(std::shared_ptr<const transillum::viewer::LoadedScene> loaded);
  /// The open scene has other patches, of a round of refinement or of a new run.
  void patches_changed(std::shared_ptr<const transillum::viewer::LoadedScene> loaded);
  void snapshot_ready(std::shared_ptr<const transillum::viewer::SolverSnapshot> snapshot);
  /// @param share  done, 0 to 1; negative: unknown
  void load_progressed(const QString& phase, double share);
  /// @param bad_input  the user can correct it (exit status 2)
  void failed(const QString& message, bool bad_input);

 private:
  /// A solver, and the plan of its stages if the solve has a goal.
  struct PlannedSolver {
    std::unique_ptr<RunningSolver> solver;
    std::optional<AccuracyPlan> plan;
    double seconds = 0;  ///< running, before this program
  };
  /// What a run is made of.
  struct RunRequest {
    SolveOptions solve;
    RefineChoice refine;
  };
  /// The beginning of a run.
  struct PreparedRun {
    std::shared_ptr<const LoadedScene> loaded;  ///< with the patches of the first round
    std::optional<RefinementPlan> rounds;
    PlannedSolver solver;
  };
  PreparedRun prepare(const std::shared_ptr<const LoadedScene>& whole, RunRequest& run,
                      const Cancellation& cancellation);
  /// @param last no round follows
  PlannedSolver make_solver(const LoadedScene& loaded, const SolveOptions& options, bool last,
                            const Cancellation& cancellation);
  std::optional<PlannedSolver> resumed(const LoadedScene& loaded, const SolveOptions& options,
                                       bool last, const Cancellation& cancellation);

  void deliver_snapshot();
  // The rest runs on the worker's thread.
  void work();
  void work_once(std::unique_lock<std::mutex>& lock);
  void load(const OpenRequest& request);
  std::shared_ptr<const LoadedScene> divided(const std::shared_ptr<const LoadedScene>& whole,
                                             const std::shared_ptr<const Scene>& scene,
                                             const Cancellation& cancellation);
  void read_scene(const OpenRequest& request, LoadedScene& loaded,
                  const Cancellation& cancellation);
  SceneDescription describe(const OpenRequest& request, const Cancellation& cancellation);
  void build_tree(LoadedScene& loaded, const Cancellation& cancellation);
  void replace_scene(const OpenRequest& request, const RunRequest& options, PreparedRun run,
                     const Cancellation& cancellation);
  void start_solve(RunRequest run);
  void replace_run(PreparedRun run, const RunRequest& request);
  void take_patches(const std::shared_ptr<const LoadedScene>& loaded);
  bool holds_patches_back() const;
  void announce_patches();
  void replace_solver(PlannedSolver solver);
  void set_materials(GlossySolver& solver) const;
  void change_light(const std::shared_ptr<const PatchMaterials>& materials);
  void advance(const Goal& goal);
  bool advance_stage(const Goal& goal);
  bool begin_next_stage();
  void begin_stage();
  bool begin_next_round();
  bool in_rounds() const { return rounds_ && !rounds_->finished(); }
  void advance_exactly(std::int64_t passes);
  std::int64_t passes_so_far() const;
  void on_pass();
  void restore_history();
  void store_radiosity();
  void show_linear_parts(SolverSnapshot& snapshot);
  void store_directions();
  void store_errors();
  void post(std::function<void()> message);
  void post_state(RunState state);
  void post_snapshot();
  void assemble_form_factors();
  bool form_factors_are_due(const SolveProgress& progress) const;
  void use_stored_result(SolverSnapshot& snapshot) const;
  static void count_uncertain_patches(SolverSnapshot& snapshot);
  void post_form_factors();
  void post_load_progress(const QString& phase, double share);
  void post_current_failure(const QString& no_memory = {});
  void post_failure(const QString& message, bool bad_input);
  RunState idle_state() const;

  RunState state_ = RunState::empty;              // as last reported to the window
  std::shared_ptr<const LoadedScene> announced_;  // last scene_loaded()

  std::mutex mutex_;  // guards all down to `pending_snapshot_`
  std::condition_variable wake_;
  std::optional<OpenRequest> open_request_;
  std::optional<RunRequest> restart_request_;
  std::optional<std::shared_ptr<const PatchMaterials>> relight_request_;
  Goal goal_;
  std::uint64_t goal_number_ = 0;
  bool form_factors_requested_ = false;
  bool quit_ = false;
  bool loading_ = false;
  RunRequest options_;
  Cancellation load_cancellation_;   // of the running or the last load
  Cancellation solve_cancellation_;  // that solver_ was created with
  std::shared_ptr<const SolverSnapshot> pending_snapshot_;
  std::string go_on_with_;  // checkpoint of another program; empty: none

  CheckpointKeeper keeper_;

  std::atomic<bool> interrupted_ = false;  // pause after the current pass
  std::atomic<int> refresh_interval_ = 66;
  std::atomic<bool> includes_form_factors_ = false;

  // Used by the worker's thread only.
  std::shared_ptr<const LoadedScene> loaded_;
  std::unique_ptr<RunningSolver> solver_;
  std::shared_ptr<const PatchMaterials> materials_;  // of glossy runs; null: the scene's
  std::optional<AccuracyPlan> plan_;
  RunRequest run_;                        // of solver_
  std::optional<RefinementPlan> rounds_;  // of run_; none without refinement
  bool patches_to_announce_ = false;      // those of loaded_
  QElapsedTimer since_patches_;
  double seconds_running_ = 0;     // of the solve of the round, all stages
  std::vector<ErrorBand> errors_;  // as in SolverSnapshot
  std::vector<std::shared_ptr<const std::vector<Vec3>>> kept_directions_;
  std::vector<int> kept_passes_;
  std::vector<std::shared_ptr<const std::vector<Rgb>>> kept_radiosity_;
  std::vector<std::shared_ptr<const std::vector<LinearPart>>> kept_linear_parts_;
  std::shared_ptr<const std::vector<LinearBasis>> bases_;  // of loaded_; null: not needed yet
  std::shared_ptr<const Scene> scene_of_bases_;
  std::shared_ptr<const FormFactors> form_factors_;
  std::int64_t form_factors_passes_ = 0;  // number of passes in form_factors_
  bool form_factors_fit_ = true;
  bool more_to_do_ = false;
  std::optional<RunRequest> failed_start_;  // of a run that failed to start; solver_ is canceled
  QElapsedTimer since_snapshot_;
  double snapshot_cost_ms_ = 0;
  std::vector<double> iteration_changes_;  // of the newest iteration with all its passes
  int changes_iteration_ = 0;

  std::thread worker_;
};

}  // namespace transillum::viewer
