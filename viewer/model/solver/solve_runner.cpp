// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The thread that loads scenes and solves them. Commands from the window set requests and a goal;
// the thread handles one at a time (work()) and posts back what the worker reports.
#include "model/solver/solve_runner.h"

#include <cstdio>
#include <new>
#include <utility>

#include "support/thread_priority.h"

namespace transillum::viewer {

namespace {

/// Runs a part of the loop without the lock, and posts its failure.
template <class Work>
void run_unlocked(std::unique_lock<std::mutex>& lock, SolveMessages& messages, const Work& work) {
  lock.unlock();
  try {
    try {
      work();
    } catch (...) {
      messages.post_current_failure();
    }
  } catch (...) {
    // No memory for the report, nor for qWarning(). The next request may succeed; an exception that
    // left the thread would end the program.
    std::fputs("transillum-viewer: not enough memory to report a failure\n", stderr);
  }
  lock.lock();
}

}  // namespace

SolveRunner::SolveRunner(QObject* parent) : SolveMessages(parent), thread_([this] { work(); }) {}

SolveRunner::~SolveRunner() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    load_cancellation_.cancel();
    solve_cancellation_.cancel();
    replace_goal({});
  }
  thread_.join();
}

/// Lets the worker look for the newest request. To be called with the lock.
void SolveRunner::replace_goal(Goal goal) {
  goal_ = goal;
  ++goal_number_;
  worker_.interrupt();
  wake_.notify_one();
}

void SolveRunner::set_goal(Goal goal) {
  const std::lock_guard lock(mutex_);
  replace_goal(goal);
}

void SolveRunner::open(OpenRequest request) {
  const std::lock_guard lock(mutex_);
  // A running load is canceled; a solve only pauses, and continues if this load fails.
  if (loading_) {
    load_cancellation_.cancel();
  }
  open_request_ = std::move(request);
  restart_is_older_ = restart_request_.has_value();
  worker_.interrupt();
  wake_.notify_one();
}

void SolveRunner::stop() {
  const std::lock_guard lock(mutex_);
  if (open_request_) {
    // The solve that was paused for loading continues.
    open_request_.reset();
    ++goal_number_;
    return;
  }
  if (loading_) {
    load_cancellation_.cancel();
  } else if (!worker_.is_preparing()) {  // else there is nothing to discard
    solve_cancellation_.cancel();
    if (!restart_request_) {
      restart_request_ = choice_;
    }
  }
  replace_goal({});
}

void SolveRunner::restart(SolveWorker::Choice choice, Goal then) {
  const std::lock_guard lock(mutex_);
  if (!loading_) {
    solve_cancellation_.cancel();
  }
  restart_request_ = std::move(choice);
  restart_is_older_ = false;
  relight_request_.reset();
  replace_goal(then);
}

void SolveRunner::relight(std::shared_ptr<const PatchMaterials> materials) {
  const std::lock_guard lock(mutex_);
  relight_request_ = std::move(materials);
  replace_goal({Goal::Kind::finished});
}

void SolveRunner::include_form_factors() {
  if (!worker_.request_form_factors()) {
    return;
  }
  const std::lock_guard lock(mutex_);
  form_factors_requested_ = true;
  wake_.notify_one();
}

void SolveRunner::work() {
  lower_thread_priority();
  std::unique_lock lock(mutex_);
  while (!quit_) {
    try {
      work_once(lock);
    } catch (const std::bad_alloc&) {
      // No memory to begin a request: tried again.
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
    post_state(worker_.state());
  }
  wake_.wait(lock, has_work);
  if (quit_) {
    return;
  }
  worker_.interrupt(false);

  if (open_request_) {
    load_cancellation_ = Cancellation();
    const OpenRequest request = *std::exchange(open_request_, std::nullopt);
    loading_ = true;
    run_unlocked(lock, *this,
                 [&, cancellation = load_cancellation_] { load(request, cancellation); });
    loading_ = false;
  } else if (restart_request_) {
    solve_cancellation_ = Cancellation();
    choice_ = *std::exchange(restart_request_, std::nullopt);
    const bool runs_on = goal_.kind == Goal::Kind::finished;
    const std::uint64_t number = goal_number_;
    run_unlocked(lock, *this, [&, run = choice_, cancellation = solve_cancellation_] {
      worker_.start(run, cancellation, runs_on);
    });
    if (!worker_.has_started() && number == goal_number_ && !open_request_) {
      goal_ = {};
    }
  } else if (relight_request_) {
    const auto materials = *std::exchange(relight_request_, std::nullopt);
    run_unlocked(lock, *this, [&] { worker_.relight(materials); });
  } else if (form_factors_requested_) {
    form_factors_requested_ = false;
    run_unlocked(lock, *this, [&] { worker_.post_snapshot(); });
  } else {
    const Goal goal = goal_;
    const std::uint64_t number = goal_number_;
    run_unlocked(lock, *this, [&] { worker_.advance(goal); });
    // Keep a goal that was interrupted by a load: the solve continues if that load fails.
    if (number == goal_number_ && !open_request_) {
      goal_ = {};
    }
  }
}

void SolveRunner::load(const OpenRequest& request, const Cancellation& cancellation) {
  post_state(RunState::loading);
  try {
    const bool runs_on = request.then.kind == Goal::Kind::finished;
    SolveWorker::Prepared prepared =
        request.earlier ? worker_.prepare(request.earlier, SolveWorker::choice_of(request.options),
                                          cancellation, cancellation)
                        : worker_.load(request.spec, request.options, request.first_look,
                                       cancellation, runs_on, request.faces);
    {
      const std::lock_guard lock(mutex_);
      cancellation.throw_if_canceled();
      // From here on, stop() stops the solve of the new scene.
      solve_cancellation_ = cancellation;
      loading_ = false;
      choice_ = prepared.choice;
      if (restart_is_older_) {
        restart_request_.reset();
      }
      relight_request_.reset();
      replace_goal(request.then);
      worker_.interrupt(false);  // a draft is part of what follows
    }
    worker_.open(std::move(prepared));
  } catch (...) {
    post_current_failure(
        tr("%1 does not fit into memory").arg(QString::fromStdString(request.spec)));
  }
}

}  // namespace transillum::viewer
