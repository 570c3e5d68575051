// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solve_runner.h"

#include <QMetaObject>
#include <algorithm>
#include <chrono>
#include <utility>

#include "support/failure_text.h"
#include "support/thread_priority.h"
#include "transillum/files.h"

namespace transillum::viewer {

namespace {

using Clock = std::chrono::steady_clock;

// All B(n) together, and all directions; later ones are not kept.
constexpr std::size_t most_kept_bytes = std::size_t{256} << 20;

// What form factors may take beside the solver's own sums.
constexpr std::int64_t most_form_factor_bytes = std::int64_t{1} << 30;

std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch())
      .count();
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
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
    // A load under way is given up; a solve merely rests, and goes on should this load fail.
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
      // The solve that was to make room goes on.
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

void SolveRunner::restart(const SolveOptions& options, Goal then) {
  {
    const std::lock_guard lock(mutex_);
    if (!loading_) {
      solve_cancellation_.cancel();
    }
    restart_request_ = options;
    goal_ = then;
    ++goal_number_;
    interrupted_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::include_form_factors() {
  if (form_factors_wanted_) {
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    form_factors_wanted_ = form_factors_asked_ = true;
  }
  wake_.notify_one();
}

void SolveRunner::aim(Goal goal) {
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
  while (true) {
    const auto anything = [this] {
      return quit_ || open_request_ || restart_request_ || form_factors_asked_ ||
             goal_.kind != Goal::Kind::rest;
    };
    if (!anything()) {
      post_state(resting_state());
    }
    wake_.wait(lock, anything);
    if (quit_) {
      return;
    }
    interrupted_ = false;

    if (open_request_) {
      const OpenRequest request = *std::exchange(open_request_, std::nullopt);
      load_cancellation_ = Cancellation();
      loading_ = true;
      lock.unlock();
      load(request);
      lock.lock();
      loading_ = false;
    } else if (restart_request_) {
      options_ = *std::exchange(restart_request_, std::nullopt);
      solve_cancellation_ = Cancellation();
      const SolveOptions options = options_;
      lock.unlock();
      begin_solve(options);
      lock.lock();
    } else if (form_factors_asked_) {
      form_factors_asked_ = false;
      lock.unlock();
      show_form_factors();
      lock.lock();
    } else {
      const Goal goal = goal_;
      const std::uint64_t number = goal_number_;
      lock.unlock();
      advance(goal);
      lock.lock();
      // A goal that was left for a load's sake is taken up again should that load fail.
      if (number == goal_number_ && !open_request_) {
        goal_ = {};
      }
    }
  }
}

void SolveRunner::load(const OpenRequest& request) {
  post_state(RunState::loading);
  const QString name = QString::fromStdString(request.spec);
  const auto report = [this](const QString& phase, double share) {
    post([this, phase, share] { emit load_progressed(phase, share); });
  };
  try {
    request.solve_options.validate();
    const Cancellation cancellation = load_cancellation_;
    const auto load_begin = Clock::now();
    auto loaded = std::make_shared<LoadedScene>();
    report(tr("Loading %1").arg(name), -1);
    if (is_result_file(request.spec)) {
      loaded->stored = std::make_shared<const Solution>(read_result(request.spec, cancellation));
      loaded->scene = loaded->stored->scene;
      loaded->file = request.spec;
    } else {
      loaded->scene = load_scene(request.spec, request.scene_options, cancellation);
    }
    loaded->picker = std::make_shared<const Picker>(loaded->scene, cancellation);
    loaded->measures = measure(*loaded->scene, cancellation);
    loaded->seconds_load = seconds_since(load_begin);

    const auto tree_begin = Clock::now();
    auto last_report = tree_begin;
    loaded->tree = std::make_shared<BspTree>(*loaded->scene, cancellation,
                                             [this, &report, &last_report](double share) {
                                               if (seconds_since(last_report) < 0.05) {
                                                 return;
                                               }
                                               last_report = Clock::now();
                                               report(tr("Sorting patches"), share);
                                             });
    loaded->seconds_bsp = seconds_since(tree_begin);

    if (request.solve_options.first_shot) {
      report(tr("Shooting small sources"), -1);
    }
    auto solver = std::make_unique<RadiositySolver>(loaded->scene, request.solve_options,
                                                    loaded->tree, cancellation);
    {
      // From here on the scene is there: who stops now stops its solve.
      const std::lock_guard lock(mutex_);
      cancellation.throw_if_canceled();
      solve_cancellation_ = cancellation;
      loading_ = false;
      options_ = request.solve_options;
      goal_ = request.then;
      ++goal_number_;
    }
    loaded_ = loaded;
    take_solver(std::move(solver));
    {
      const std::lock_guard lock(mutex_);
      mailbox_ = nullptr;  // of the scene before
    }
    post([this, loaded] {
      announced_ = loaded;
      emit scene_loaded(loaded);
      deliver_snapshot();
    });
    post_snapshot();
  } catch (const Canceled&) {
    // The user's wish: nothing to say.
  } catch (const InputError& error) {
    post_failure(QString::fromStdString(error.what()), true);
  } catch (const std::bad_alloc&) {
    post_failure(tr("%1 does not fit into memory").arg(name), false);
  } catch (const std::exception& error) {
    post_failure(failure_text(error), false);
  }
}

void SolveRunner::begin_solve(const SolveOptions& options) {
  if (!loaded_) {
    return;
  }
  try {
    take_solver(std::make_unique<RadiositySolver>(loaded_->scene, options, loaded_->tree,
                                                  solve_cancellation_));
    post_snapshot();
  } catch (const Canceled&) {
    // Another wish has come in the meantime; the loop sees to it.
  } catch (const InputError& error) {
    post_failure(QString::fromStdString(error.what()), true);
  } catch (const std::exception& error) {
    post_failure(failure_text(error), false);
  }
}

void SolveRunner::take_solver(std::unique_ptr<RadiositySolver> solver) {
  solver_ = std::move(solver);
  solver_->keep_form_factors();
  kept_directions_ = {std::make_shared<const std::vector<Vec3>>(solver_->directions())};
  kept_passes_ = {solver_->progress().passes};
  kept_radiosity_.clear();
  form_factors_ = nullptr;
  form_factors_passes_ = 0;
  form_factors_fit_ = true;
  more_to_do_ = true;
}

void SolveRunner::keep_radiosity() {
  const auto iteration = static_cast<std::size_t>(solver_->progress().iteration);
  if (iteration < kept_radiosity_.size()) {
    return;
  }
  const std::vector<Rgb>& radiosity = solver_->radiosity();
  kept_radiosity_.resize(iteration + 1);
  if (radiosity.size() * (iteration + 1) * sizeof(Rgb) <= most_kept_bytes) {
    kept_radiosity_[iteration] = std::make_shared<const std::vector<Rgb>>(radiosity);
  }
}

void SolveRunner::keep_directions() {
  const SolveProgress progress = solver_->progress();
  const std::size_t begun =
      static_cast<std::size_t>(progress.iteration) + (progress.direction > 0 ? 1 : 0);
  while (kept_directions_.size() < begun) {
    const std::vector<Vec3>& directions = solver_->directions();
    if (solver_->options().scheme != Scheme::semi_iterative) {
      kept_directions_.push_back(kept_directions_.front());
    } else if (directions.size() * begun * sizeof(Vec3) <= most_kept_bytes) {
      kept_directions_.push_back(std::make_shared<const std::vector<Vec3>>(directions));
    } else {
      kept_directions_.push_back(nullptr);
    }
    kept_passes_.push_back(progress.passes);
  }
}

std::int64_t SolveRunner::passes_so_far() const {
  return passes_done(solver_->progress(), kept_passes_);
}

void SolveRunner::advance(const Goal& goal) {
  if (!solver_ || !more_to_do_) {
    return;
  }
  if (goal.kind == Goal::Kind::passes && passes_so_far() >= goal.passes) {
    return;
  }
  post_state(RunState::running);
  using Until = RadiositySolver::Until;
  try {
    if (goal.kind == Goal::Kind::passes) {
      advance_exactly(goal.passes);
    } else {
      const Until until = goal.kind == Goal::Kind::direction   ? Until::direction
                          : goal.kind == Goal::Kind::iteration ? Until::iteration
                                                               : Until::finished;
      more_to_do_ = solver_->advance(until, [this](const RadiositySolver& solver) {
        on_pass(solver);
        return !interrupted_.load(std::memory_order_relaxed);
      });
    }
  } catch (const Canceled&) {
    return;
  } catch (const std::exception& error) {
    more_to_do_ = false;
    post_failure(failure_text(error), false);
  }
  try {
    post_snapshot();
  } catch (const std::bad_alloc&) {
    post_failure(tr("There is no memory left to show the result"), false);
  }
}

void SolveRunner::advance_exactly(std::int64_t passes) {
  // Passes under way on other threads are finished after a pause: leave room for them, then take
  // the last ones one by one.
  const int room = 2 * std::max(solver_->statistics().threads, 1);
  const auto go_on = [this](std::int64_t wanted) {
    return more_to_do_ && !interrupted_.load(std::memory_order_relaxed) && passes_so_far() < wanted;
  };
  if (go_on(passes - room)) {
    more_to_do_ =
        solver_->advance(RadiositySolver::Until::finished, [&](const RadiositySolver& solver) {
          on_pass(solver);
          return !interrupted_.load(std::memory_order_relaxed) && passes_so_far() < passes - room;
        });
  }
  while (go_on(passes)) {
    more_to_do_ =
        solver_->advance(RadiositySolver::Until::direction, [this](const RadiositySolver& solver) {
          on_pass(solver);
          return true;
        });
  }
}

void SolveRunner::on_pass(const RadiositySolver& solver) {
  keep_radiosity();
  keep_directions();
  const SolveProgress progress = solver.progress();
  if (progress.direction == progress.passes) {
    // Finishing the step will clear them.
    step_changes_ = solver.estimate_changes();
    step_changes_iteration_ = progress.iteration;
  }
  // Making a snapshot may take a fifth of the solver's time at most.
  const double interval_ms =
      std::max<double>(refresh_interval_.load(std::memory_order_relaxed), 5 * snapshot_cost_ms_);
  const bool due = static_cast<double>(now_ns() - last_snapshot_ns_) > 1e6 * interval_ms;
  if (due || form_factors_are_due(progress)) {
    post_snapshot();
  }
}

// They are whole between steps only, where few snapshots are taken. After that, the semi-iterative
// scheme's are worth it again when they are of twice as many passes.
bool SolveRunner::form_factors_are_due(const SolveProgress& progress) const {
  const bool between_steps = progress.direction == 0 && progress.iteration > 0;
  return form_factors_wanted_ && between_steps && form_factors_fit_ &&
         solver_->statistics().passes_made >= 2 * form_factors_passes_;
}

void SolveRunner::put_form_factors_together() {
  const SolveProgress progress = solver_->progress();
  const bool between_steps = progress.direction == 0 && progress.iteration > 0;
  if (!form_factors_wanted_ || !between_steps || !form_factors_fit_) {
    return;
  }
  const SolveStatistics statistics = solver_->statistics();
  if (statistics.passes_made == form_factors_passes_) {
    return;
  }
  constexpr std::int64_t bytes_an_entry = sizeof(PatchId) + sizeof(double);
  const int ways = solver_->options().two_way ? 2 : 1;
  form_factors_fit_ = statistics.kept_form_factors &&
                      ways * statistics.form_factors * bytes_an_entry <= most_form_factor_bytes;
  form_factors_ = nullptr;
  if (!form_factors_fit_) {
    return;
  }
  try {
    form_factors_ = std::make_shared<const FormFactors>(solver_->form_factors());
    form_factors_passes_ = statistics.passes_made;
  } catch (const std::bad_alloc&) {
    form_factors_fit_ = false;
  }
}

void SolveRunner::show_form_factors() {
  if (!solver_) {
    return;
  }
  try {
    post_snapshot();
  } catch (const Canceled&) {
    // Another wish has come in the meantime; the loop sees to it.
  } catch (const std::exception& error) {
    post_failure(failure_text(error), false);
  }
}

void SolveRunner::post_snapshot() {
  const std::int64_t begin = now_ns();
  keep_radiosity();
  put_form_factors_together();
  auto snapshot = std::make_shared<SolverSnapshot>();
  snapshot->loaded = loaded_;
  snapshot->options = solver_->options();
  snapshot->progress = solver_->progress();
  keep_directions();
  snapshot->kept_directions = kept_directions_;
  snapshot->kept_passes = kept_passes_;
  snapshot->directions = kept_directions_.back()
                             ? kept_directions_.back()
                             : std::make_shared<const std::vector<Vec3>>(solver_->directions());
  snapshot->statistics = solver_->statistics();
  snapshot->radiosity = solver_->running_estimate();
  snapshot->irradiance = solver_->irradiance();
  snapshot->form_factors = form_factors_;
  snapshot->shot = solver_->direct_light();
  snapshot->form_factors_fit = form_factors_fit_;
  snapshot->kept_radiosity = kept_radiosity_;
  snapshot->form_factor_sums = solver_->form_factor_sums();
  snapshot->estimate_changes = solver_->estimate_changes();
  snapshot->quadrature_errors = solver_->quadrature_errors();
  snapshot->error = solver_->error_estimate();
  snapshot->estimate_iteration = snapshot->progress.iteration;
  if (snapshot->estimate_changes.empty() && snapshot->progress.iteration > 0) {
    snapshot->estimate_changes = step_changes_;
    snapshot->estimate_iteration = step_changes_iteration_;
  }
  lay_out_stored(*snapshot);
  last_snapshot_ns_ = now_ns();
  snapshot_cost_ms_ = static_cast<double>(last_snapshot_ns_ - begin) * 1e-6;
  {
    const std::lock_guard lock(mutex_);
    const bool message_under_way = mailbox_ != nullptr;
    mailbox_ = std::move(snapshot);
    if (message_under_way) {
      return;
    }
  }
  post([this] { deliver_snapshot(); });
}

// Until the first direction, what a result's file tells is more than the solver knows.
void SolveRunner::lay_out_stored(SolverSnapshot& snapshot) const {
  const auto& stored = loaded_->stored;
  snapshot.of_file = stored && passes_done(snapshot.progress, snapshot.kept_passes) == 0;
  if (!snapshot.of_file) {
    return;
  }
  snapshot.radiosity = stored->radiosity;
  snapshot.irradiance = stored->irradiance;
  snapshot.error = stored->error;
  snapshot.statistics = stored->statistics;
}

void SolveRunner::deliver_snapshot() {
  std::shared_ptr<const SolverSnapshot> newest;
  {
    const std::lock_guard lock(mutex_);
    // That of a scene which is still to be announced waits for it.
    if (!mailbox_ || mailbox_->loaded != announced_) {
      return;
    }
    newest = std::exchange(mailbox_, nullptr);
  }
  emit snapshot_ready(newest);
}

RunState SolveRunner::resting_state() const {
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

void SolveRunner::post_failure(const QString& message, bool bad_input) {
  post([this, message, bad_input] { emit failed(message, bad_input); });
}

void SolveRunner::post(std::function<void()> message) {
  QMetaObject::invokeMethod(this, std::move(message), Qt::QueuedConnection);
}

}  // namespace transillum::viewer
