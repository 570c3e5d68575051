// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

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

#include "model/snapshot.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// How far the worker shall go before it rests.
struct Goal {
  enum class Kind { rest, direction, iteration, passes, finished };
  Kind kind = Kind::rest;
  std::int64_t passes = 0;  ///< for Kind::passes: passes_done() of the solve
};

/// Loads and solves on a thread of its own; the window commands it and hears of it.
///
/// Threads: the public functions and all signals belong to the thread that made the session.
/// Commands return at once; the newest one wins. Snapshots are immutable, and one that the window
/// has not taken yet is replaced by its successor.
class SolveRunner : public QObject {
  Q_OBJECT

 public:
  struct OpenRequest {
    std::string spec;  ///< file or built-in
    SceneOptions scene_options;
    SolveOptions solve_options;
    Goal then;  ///< what to do once it is open
  };

  explicit SolveRunner(QObject* parent = nullptr);
  ~SolveRunner() override;

  /// Loads; the old scene stays where loading fails or is stopped.
  void open(OpenRequest request);
  /// Goes on until the goal is reached.
  void pursue(Goal goal) { aim(goal); }
  void run() { aim({Goal::Kind::finished}); }
  void pause() { aim({Goal::Kind::rest}); }
  void advance_one_direction() { aim({Goal::Kind::direction}); }
  void advance_one_iteration() { aim({Goal::Kind::iteration}); }
  /// Ends loading; or forgets the solve and goes back to the first direction.
  void stop();
  /// Solves the open scene anew.
  void restart(const SolveOptions& options, Goal then);

  /// From now on snapshots have the form factors, where the memory takes them.
  void include_form_factors();

  RunState state() const { return state_; }
  /// Between two snapshots lie at least so many milliseconds.
  void set_refresh_interval(int milliseconds) { refresh_interval_ = milliseconds; }

 signals:
  void state_changed(transillum::viewer::RunState state);
  void scene_loaded(std::shared_ptr<const transillum::viewer::LoadedScene> loaded);
  void snapshot_ready(std::shared_ptr<const transillum::viewer::SolverSnapshot> snapshot);
  /// `share` done in [0,1]; negative: not known.
  void load_progressed(const QString& phase, double share);
  /// `bad_input`: the user's to mend (exit status 2).
  void failed(const QString& message, bool bad_input);

 private:
  void aim(Goal goal);
  void deliver_snapshot();
  // The rest runs on the worker's thread.
  void work();
  void load(const OpenRequest& request);
  void begin_solve(const SolveOptions& options);
  void take_solver(std::unique_ptr<RadiositySolver> solver);
  void advance(const Goal& goal);
  void advance_exactly(std::int64_t passes);
  std::int64_t passes_so_far() const;
  void on_pass(const RadiositySolver& solver);
  void keep_radiosity();
  void keep_directions();
  void post(std::function<void()> message);
  void post_state(RunState state);
  void post_snapshot();
  void put_form_factors_together();
  bool form_factors_are_due(const SolveProgress& progress) const;
  void lay_out_stored(SolverSnapshot& snapshot) const;
  void show_form_factors();
  void post_failure(const QString& message, bool bad_input);
  RunState resting_state() const;

  RunState state_ = RunState::empty;              // as the window knows it
  std::shared_ptr<const LoadedScene> announced_;  // likewise

  std::mutex mutex_;  // guards all down to `mailbox_`
  std::condition_variable wake_;
  std::optional<OpenRequest> open_request_;
  std::optional<SolveOptions> restart_request_;
  Goal goal_;
  std::uint64_t goal_number_ = 0;
  bool form_factors_asked_ = false;
  bool quit_ = false;
  bool loading_ = false;
  SolveOptions options_;
  Cancellation load_cancellation_;   // of the load under way, or the last one
  Cancellation solve_cancellation_;  // what solver_ was made with
  std::shared_ptr<const SolverSnapshot> mailbox_;

  std::atomic<bool> interrupted_ = false;  // asks the solver to rest after the pass under way
  std::atomic<int> refresh_interval_ = 66;
  std::atomic<bool> form_factors_wanted_ = false;

  // The worker's own.
  std::shared_ptr<const LoadedScene> loaded_;
  std::unique_ptr<RadiositySolver> solver_;
  std::vector<std::shared_ptr<const std::vector<Vec3>>> kept_directions_;
  std::vector<int> kept_passes_;
  std::vector<std::shared_ptr<const std::vector<Rgb>>> kept_radiosity_;
  std::shared_ptr<const FormFactors> form_factors_;
  std::int64_t form_factors_passes_ = 0;  // that form_factors_ were made of
  bool form_factors_fit_ = true;
  bool more_to_do_ = false;
  std::int64_t last_snapshot_ns_ = 0;
  double snapshot_cost_ms_ = 0;
  std::vector<double> step_changes_;  // of the newest step that took all its passes
  int step_changes_iteration_ = 0;

  std::thread worker_;
};

}  // namespace transillum::viewer
