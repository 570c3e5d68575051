// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The worker thread that loads scenes and solves them. Commands from the window set requests and a
// goal; the worker handles one at a time (work()), advances the solver toward the goal, and posts
// snapshots, states and failures back to the window's thread.
#include "model/solve_runner.h"

#include <QMetaObject>
#include <algorithm>
#include <new>
#include <utility>

#include "support/elapsed.h"
#include "support/failure_text.h"
#include "support/thread_priority.h"
#include "transillum/errors.h"

namespace transillum::viewer {

namespace {

// Limit for the form factors in addition to the solver's sums.
constexpr std::int64_t most_form_factor_bytes = std::int64_t{1} << 30;

/// Runs a part of the worker's loop, which reports its own failures. If there is no memory for the
/// report either, the next request may succeed; an exception that left the thread would end the
/// program.
template <class Part>
void run_unlocked(std::unique_lock<std::mutex>& lock, const Part& part) {
  lock.unlock();
  try {
    part();
  } catch (...) {
  }
  lock.lock();
}

}  // namespace

SolveRunner::SolveRunner(QObject* parent) : QObject(parent), worker_([this] { work(); }) {}

SolveRunner::~SolveRunner() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    interrupted_ = true;
    load_cancellation_.cancel();
    solve_cancellation_.cancel();
  }
  wake_.notify_one();
  worker_.join();
}

void SolveRunner::open(OpenRequest request) {
  {
    const std::lock_guard lock(mutex_);
    // A running load is canceled; a solve only pauses, and continues if this load fails.
    if (loading_) {
      load_cancellation_.cancel();
    }
    open_request_ = std::move(request);
    interrupted_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::stop() {
  {
    const std::lock_guard lock(mutex_);
    if (open_request_) {
      // The solve that was paused for loading continues.
      open_request_.reset();
      ++goal_number_;
      return;
    }
    if (loading_) {
      load_cancellation_.cancel();
    } else {
      solve_cancellation_.cancel();
      if (!restart_request_) {
        restart_request_ = options_;
      }
    }
    goal_ = {};
    ++goal_number_;
    interrupted_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::restart(const SolveOptions& options, Goal then, const RefineChoice& refine) {
  {
    const std::lock_guard lock(mutex_);
    if (!loading_) {
      solve_cancellation_.cancel();
    }
    restart_request_ = {options, refine};
    relight_request_.reset();
    goal_ = then;
    ++goal_number_;
    interrupted_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::relight(std::shared_ptr<const PatchMaterials> materials) {
  {
    const std::lock_guard lock(mutex_);
    relight_request_ = std::move(materials);
    goal_ = {Goal::Kind::finished};
    ++goal_number_;
    interrupted_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::include_form_factors() {
  if (includes_form_factors_) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    includes_form_factors_ = form_factors_requested_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::keep_in(std::string file, double interval) {
  keeper_.set_file(std::move(file), interval);
}

void SolveRunner::go_on_with(std::string file) {
  const std::lock_guard lock(mutex_);
  go_on_with_ = std::move(file);
}

void SolveRunner::set_goal(Goal goal) {
  {
    const std::lock_guard lock(mutex_);
    goal_ = goal;
    ++goal_number_;
    interrupted_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::work() {
  lower_thread_priority();
  std::unique_lock lock(mutex_);
  while (!quit_) {
    try {
      work_once(lock);
    } catch (const std::bad_alloc&) {
      // No memory to begin a request, or for the message that none is left: tried again.
    }
  }
}

/// Waits for the next request, then handles it without holding the lock.
void SolveRunner::work_once(std::unique_lock<std::mutex>& lock) {
  const auto has_work = [this] {
    return quit_ || open_request_ || restart_request_ || relight_request_ ||
           form_factors_requested_ || goal_.kind != Goal::Kind::pause;
  };
  if (!has_work()) {
    post_state(idle_state());
  }
  wake_.wait(lock, has_work);
  if (quit_) {
    return;
  }
  interrupted_ = false;

  if (open_request_) {
    load_cancellation_ = Cancellation();
    const OpenRequest request = *std::exchange(open_request_, std::nullopt);
    loading_ = true;
    run_unlocked(lock, [&] { load(request); });
    loading_ = false;
  } else if (restart_request_) {
    solve_cancellation_ = Cancellation();
    options_ = *std::exchange(restart_request_, std::nullopt);
    const RunRequest run = options_;
    run_unlocked(lock, [&] { start_solve(run); });
  } else if (relight_request_) {
    const auto materials = *std::exchange(relight_request_, std::nullopt);
    run_unlocked(lock, [&] { change_light(materials); });
  } else if (form_factors_requested_) {
    form_factors_requested_ = false;
    run_unlocked(lock, [&] { post_form_factors(); });
  } else {
    const Goal goal = goal_;
    const std::uint64_t number = goal_number_;
    run_unlocked(lock, [&] { advance(goal); });
    // Keep a goal that was interrupted by a load: the solve continues if that load fails.
    if (number == goal_number_ && !open_request_) {
      goal_ = {};
    }
  }
}

void SolveRunner::start_solve(RunRequest run) {
  if (!loaded_) {
    return;
  }
  try {
    // The old solver has been canceled: if this fails, the next goal tries again.
    failed_start_ = run;
    more_to_do_ = true;
    PreparedRun prepared = prepare(whole_of(loaded_), run, solve_cancellation_);
    if (prepared.solver.solver->glossy() != nullptr && materials_) {
      set_materials(*prepared.solver.solver->glossy());
    }
    keeper_.begin(prepared.loaded->scene, run.solve);
    take_patches(prepared.loaded);
    replace_run(std::move(prepared), run);
    post_snapshot();
  } catch (...) {
    if (failed_start_) {
      const std::lock_guard lock(mutex_);
      if (!open_request_ && !restart_request_) {
        goal_ = {};
      }
    }
    post_current_failure();
  }
}

void SolveRunner::take_patches(const std::shared_ptr<const LoadedScene>& loaded) {
  if (loaded == loaded_) {
    return;
  }
  loaded_ = loaded;
  patches_to_announce_ = true;
  since_patches_.start();
}

/// The first passes of a round would show a dark scene in place of the finished one before it.
bool SolveRunner::holds_patches_back() const {
  constexpr qint64 longest_ms = 1000;
  return patches_to_announce_ && rounds_ && !rounds_->rounds().empty() &&
         solver_->progress().iteration == 0 && since_patches_.elapsed() < longest_ms;
}

void SolveRunner::announce_patches() {
  if (!std::exchange(patches_to_announce_, false)) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    pending_snapshot_ = nullptr;  // with the patches before
  }
  post([this, loaded = loaded_] {
    announced_ = loaded;
    emit patches_changed(loaded);
    deliver_snapshot();
  });
}

void SolveRunner::replace_run(PreparedRun run, const RunRequest& request) {
  run_ = request;
  rounds_ = std::move(run.rounds);
  replace_solver(std::move(run.solver));
}

/// Those of materials_, from the light of before.
void SolveRunner::set_materials(GlossySolver& solver) const {
  const auto from = GlossySolver::Start::current;
  if (materials_) {
    solver.set_materials(materials_->materials, materials_->of_patch, from);
  } else {
    solver.set_materials(loaded_->scene->materials(), {}, from);
  }
}

void SolveRunner::change_light(const std::shared_ptr<const PatchMaterials>& materials) {
  if (!solver_ || solver_->glossy() == nullptr || failed_start_) {
    return;
  }
  try {
    materials_ = materials;
    set_materials(*solver_->glossy());
    kept_radiosity_.clear();
    restore_history();
    more_to_do_ = true;
  } catch (...) {
    post_current_failure();
  }
}

void SolveRunner::replace_solver(PlannedSolver made) {
  solver_ = std::move(made.solver);
  plan_ = std::move(made.plan);
  seconds_running_ = made.seconds;
  errors_.clear();
  iteration_changes_.clear();
  if (solver_->diffuse() != nullptr) {
    solver_->diffuse()->keep_form_factors();
  }
  restore_history();
  kept_radiosity_.clear();
  kept_linear_parts_.clear();
  form_factors_ = nullptr;
  form_factors_passes_ = 0;
  form_factors_fit_ = true;
  more_to_do_ = true;
  failed_start_.reset();
}

std::int64_t SolveRunner::passes_so_far() const {
  return passes_done(solver_->progress(), kept_passes_);
}

void SolveRunner::advance(const Goal& goal) {
  if (failed_start_) {
    const RunRequest run = *failed_start_;
    start_solve(run);
  }
  if (!solver_ || !more_to_do_ || failed_start_) {
    return;
  }
  const bool by_passes = goal.kind == Goal::Kind::passes;
  if (by_passes && !in_rounds() && passes_so_far() >= goal.passes) {
    return;
  }
  post_state(RunState::running);
  bool another = true;
  while (another) {
    const Goal next = by_passes && in_rounds() ? Goal{Goal::Kind::finished} : goal;
    another = advance_stage(next) && next.kind == Goal::Kind::finished && !interrupted_;
  }
}

/// Advances the solver; where its stage ends, begins the next.
/// @returns whether a next stage has begun.
bool SolveRunner::advance_stage(const Goal& goal) {
  using Until = RunningSolver::Until;
  QElapsedTimer timer;
  timer.start();
  bool stage_begins = false, diverged = false;
  try {
    if (goal.kind == Goal::Kind::passes) {
      advance_exactly(goal.passes);
    } else {
      const Until until = goal.kind == Goal::Kind::direction   ? Until::direction
                          : goal.kind == Goal::Kind::iteration ? Until::iteration
                                                               : Until::finished;
      more_to_do_ = solver_->advance(until, [this] {
        on_pass();
        return !interrupted_.load(std::memory_order_relaxed);
      });
    }
    seconds_running_ += seconds(timer);
    if (solver_->diffuse() != nullptr) {
      keeper_.save_soon(*solver_->diffuse(), plan_ ? &*plan_ : nullptr);
    }
    stage_begins = !more_to_do_ && begin_next_stage();
    more_to_do_ = more_to_do_ || stage_begins;
  } catch (const Canceled&) {
    return false;
  } catch (const NotConvergent&) {
    seconds_running_ += seconds(timer);
    diverged = plan_ && plan_->enlarge();
    if (!diverged) {
      more_to_do_ = false;
      post_failure(current_failure_text(), false);
    }
  } catch (...) {
    more_to_do_ = false;
    post_failure(current_failure_text(), false);
  }
  try {
    if (diverged) {
      begin_stage();
      stage_begins = true;
    }
    const bool goes_on = stage_begins && goal.kind == Goal::Kind::finished && !interrupted_;
    if (!goes_on || !holds_patches_back()) {
      post_snapshot();
    }
  } catch (...) {
    post_current_failure(tr("Not enough memory to show the result"));
  }
  return stage_begins;
}

/// @returns whether there is one.
bool SolveRunner::begin_next_stage() {
  if (!plan_) {
    return begin_next_round();
  }
  store_errors();
  const AccuracyPlan::Next next = plan_->next(*solver_->diffuse(), seconds_running_);
  if (next == AccuracyPlan::Next::done) {
    return begin_next_round();
  }
  if (next == AccuracyPlan::Next::replica) {
    solver_->diffuse()->add_replica();
    kept_directions_.front() = std::make_shared<const std::vector<Vec3>>(solver_->directions());
    return true;
  }
  begin_stage();
  return true;
}

/// Divides patches by the solve that has finished.
/// @returns whether a solve follows; if no round is left, that of the refined scene.
bool SolveRunner::begin_next_round() {
  if (!in_rounds()) {
    return false;
  }
  const Cancellation& cancellation = solve_cancellation_;
  post_snapshot();  // the end of the round
  rounds_->assess(solver_->diffuse()->solution(), seconds_running_, cancellation);
  rounds_->divide_worst(cancellation);
  const auto loaded = divided(whole_of(loaded_), rounds_->scene(), cancellation);
  PlannedSolver solver = make_solver(*loaded, run_.solve, !in_rounds(), cancellation);
  keeper_.begin(loaded->scene, run_.solve);
  take_patches(loaded);
  replace_solver(std::move(solver));
  return true;
}

void SolveRunner::begin_stage() {
  const double running = seconds_running_;
  auto solver =
      std::make_unique<RadiositySolver>(loaded_->scene, plan_->stage(), loaded_->tree,
                                        solve_cancellation_, solver_->diffuse()->direct_light());
  replace_solver({std::make_unique<RunningSolver>(std::move(solver)), std::move(plan_), running});
}

void SolveRunner::advance_exactly(std::int64_t passes) {
  // The solver finishes the passes that run on other threads before it pauses, or its group of
  // passes: stop early enough, then make the last passes one by one.
  const int at_once = solver_->diffuse() != nullptr ? 2 : 4;  // by each thread
  const int margin = at_once * std::max(solver_->statistics().threads, 1);
  const auto is_below = [this](std::int64_t target) {
    return more_to_do_ && !interrupted_.load(std::memory_order_relaxed) && passes_so_far() < target;
  };
  if (is_below(passes - margin)) {
    more_to_do_ = solver_->advance(RunningSolver::Until::finished, [&] {
      on_pass();
      return !interrupted_.load(std::memory_order_relaxed) && passes_so_far() < passes - margin;
    });
  }
  while (is_below(passes)) {
    more_to_do_ = solver_->advance(RunningSolver::Until::direction, [this] {
      on_pass();
      return true;
    });
  }
}

void SolveRunner::on_pass() {
  store_radiosity();
  store_directions();
  store_errors();
  const SolveProgress progress = solver_->progress();
  if (progress.direction == progress.passes) {
    // Store them: the solver clears them at the end of the iteration.
    iteration_changes_ = solver_->estimate_changes();
    changes_iteration_ = progress.iteration;
  }
  if (solver_->diffuse() != nullptr) {
    keeper_.save_if_due(*solver_->diffuse(), plan_ ? &*plan_ : nullptr);
  }
  // Snapshots take at most a fifth of the solver's time.
  const double interval_ms =
      std::max<double>(refresh_interval_.load(std::memory_order_relaxed), 5 * snapshot_cost_ms_);
  const bool due = !since_snapshot_.isValid() ||
                   static_cast<double>(since_snapshot_.nsecsElapsed()) > 1e6 * interval_ms;
  if ((due || form_factors_are_due(progress)) && !holds_patches_back()) {
    post_snapshot();
  }
}

// Form factors are complete only between iterations, where few snapshots are made. In the
// semi-iterative scheme, they are assembled again when the number of passes has doubled.
bool SolveRunner::form_factors_are_due(const SolveProgress& progress) const {
  const bool between_iterations = progress.direction == 0 && progress.iteration > 0;
  return includes_form_factors_ && between_iterations && form_factors_fit_ &&
         solver_->diffuse() != nullptr &&
         solver_->statistics().passes_made >= 2 * form_factors_passes_;
}

void SolveRunner::assemble_form_factors() {
  const SolveProgress progress = solver_->progress();
  const bool between_iterations = progress.direction == 0 && progress.iteration > 0;
  if (!includes_form_factors_ || !between_iterations || !form_factors_fit_ ||
      solver_->diffuse() == nullptr) {
    return;
  }
  const SolveStatistics statistics = solver_->statistics();
  if (statistics.passes_made == form_factors_passes_) {
    return;
  }
  constexpr std::int64_t bytes_per_entry = sizeof(PatchId) + sizeof(double);
  const int directions_per_pass = solver_->options().two_way ? 2 : 1;
  form_factors_fit_ =
      statistics.kept_form_factors &&
      directions_per_pass * statistics.form_factors * bytes_per_entry <= most_form_factor_bytes;
  form_factors_ = nullptr;
  if (!form_factors_fit_) {
    return;
  }
  try {
    form_factors_ = std::make_shared<const FormFactors>(solver_->diffuse()->form_factors());
    form_factors_passes_ = statistics.passes_made;
  } catch (const std::bad_alloc&) {
    form_factors_fit_ = false;
  }
}

void SolveRunner::post_form_factors() {
  if (!solver_) {
    return;
  }
  try {
    post_snapshot();
  } catch (...) {
    post_current_failure();
  }
}

void SolveRunner::post_snapshot() {
  QElapsedTimer cost;
  cost.start();
  announce_patches();
  store_radiosity();
  assemble_form_factors();
  auto snapshot = std::make_shared<SolverSnapshot>();
  snapshot->loaded = loaded_;
  solver_->write_to(*snapshot);
  snapshot->refine = run_.refine;
  snapshot->materials = solver_->glossy() != nullptr ? materials_ : nullptr;
  store_directions();
  snapshot->kept_directions = kept_directions_;
  snapshot->kept_passes = kept_passes_;
  snapshot->directions = kept_directions_.back()
                             ? kept_directions_.back()
                             : std::make_shared<const std::vector<Vec3>>(solver_->directions());
  if (rounds_) {
    snapshot->refinement = {rounds_->refined()->patch_count(), in_rounds()};
    snapshot->statistics.refinement = rounds_->rounds();
  }
  snapshot->form_factors = form_factors_;
  snapshot->form_factors_fit = form_factors_fit_;
  snapshot->kept_radiosity = kept_radiosity_;
  snapshot->kept_linear_parts = kept_linear_parts_;
  store_errors();
  snapshot->errors = errors_;
  if (plan_ && !plan_->report().stages.empty()) {
    snapshot->accuracy = plan_->report();
  }
  snapshot->estimate_iteration = snapshot->progress.iteration;
  if (snapshot->estimate_changes.empty() && snapshot->progress.iteration > 0) {
    snapshot->estimate_changes = iteration_changes_;
    snapshot->estimate_iteration = changes_iteration_;
  }
  use_stored_result(*snapshot);
  count_uncertain_patches(*snapshot);
  show_linear_parts(*snapshot);
  since_snapshot_.start();
  snapshot_cost_ms_ = static_cast<double>(cost.nsecsElapsed()) * 1e-6;
  const std::lock_guard lock(mutex_);
  const bool message_queued = pending_snapshot_ != nullptr;
  if (!message_queued) {
    post([this] { deliver_snapshot(); });
  }
  // After post(), which may throw: a pending snapshot without its message would block all others.
  pending_snapshot_ = std::move(snapshot);
}

// Before the first direction, a result file has more than the solver.
void SolveRunner::use_stored_result(SolverSnapshot& snapshot) const {
  const auto& stored = loaded_->stored;
  snapshot.of_file = stored && passes_done(snapshot.progress, snapshot.kept_passes) == 0;
  if (!snapshot.of_file) {
    return;
  }
  snapshot.radiosity = stored->radiosity;
  snapshot.linear_parts = stored->linear_parts;
  snapshot.irradiance = stored->irradiance;
  if (!stored->form_factor_sums.empty()) {
    snapshot.form_factor_sums = stored->form_factor_sums;
  }
  snapshot.sky_shares = stored->sky_shares;
  snapshot.sky_irradiance = stored->sky_irradiance;
  snapshot.error = stored->error;
  snapshot.statistics = stored->statistics;
}

void SolveRunner::count_uncertain_patches(SolverSnapshot& snapshot) {
  if (snapshot.of_file || snapshot.error.replicas == 0) {
    return;
  }
  Solution errors;
  errors.scene = snapshot.loaded->scene;
  errors.error = snapshot.error;
  errors.statistics = snapshot.statistics;
  snapshot.uncertain_patches = std::ssize(uncertain_patches(errors));
}

void SolveRunner::deliver_snapshot() {
  std::shared_ptr<const SolverSnapshot> newest;
  {
    const std::lock_guard lock(mutex_);
    // A snapshot of a scene that is not announced yet waits for that.
    if (!pending_snapshot_ || pending_snapshot_->loaded != announced_) {
      return;
    }
    newest = std::exchange(pending_snapshot_, nullptr);
  }
  emit snapshot_ready(newest);
}

RunState SolveRunner::idle_state() const {
  if (!solver_) {
    return RunState::empty;
  }
  return more_to_do_ ? RunState::paused : RunState::finished;
}

void SolveRunner::post_state(RunState state) {
  post([this, state] {
    if (state == state_) {
      return;
    }
    state_ = state;
    emit state_changed(state);
  });
}

/// To be called in a catch block.
void SolveRunner::post_current_failure(const QString& no_memory) {
  try {
    throw;
  } catch (const Canceled&) {
    // Requested by the user, or by a newer request, which is handled next.
  } catch (const InputError& error) {
    post_failure(QString::fromStdString(error.what()), true);
  } catch (const std::bad_alloc&) {
    post_failure(no_memory.isEmpty() ? current_failure_text() : no_memory, false);
  } catch (...) {
    post_failure(current_failure_text(), false);
  }
}

void SolveRunner::post_load_progress(const QString& phase, double share) {
  post([this, phase, share] { emit load_progressed(phase, share); });
}

void SolveRunner::post_failure(const QString& message, bool bad_input) {
  post([this, message, bad_input] { emit failed(message, bad_input); });
}

void SolveRunner::post(std::function<void()> message) {
  QMetaObject::invokeMethod(this, std::move(message), Qt::QueuedConnection);
}

}  // namespace transillum::viewer
