// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/checkpoint_keeper.h"

#include <filesystem>
#include <sstream>
#include <utility>

#include "transillum/errors.h"

namespace transillum::viewer {

namespace {

constexpr double soon_fraction = 1.0 / 12;

void remove(const std::string& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
}

}  // namespace

void CheckpointKeeper::save_to(std::string file, double interval) {
  const std::lock_guard lock(mutex_);
  remove(file_);
  file_ = std::move(file);
  interval_ = interval;
  checkpoint_.reset();
}

void CheckpointKeeper::resume_from(std::string file) {
  const std::lock_guard lock(mutex_);
  resume_from_ = std::move(file);
}

bool CheckpointKeeper::restore(TotalPlan& plan, const Solve& solve,
                               const Cancellation& cancellation) {
  const std::lock_guard lock(mutex_);
  if (resume_from_.empty()) {
    return false;
  }
  try {
    std::istringstream state(Checkpoint(resume_from_, *solve.scene, solve.options, solve.total)
                                 .total_plan(cancellation));
    plan.restore(state, state.str().size(), cancellation);
    return true;
  } catch (const Canceled&) {
    throw;
  } catch (const std::runtime_error&) {
    remove(std::exchange(resume_from_, {}));
    return false;
  }
}

void CheckpointKeeper::resume(SolveSession& session, const Solve& solve) {
  std::string file;
  {
    const std::lock_guard lock(mutex_);
    file = std::exchange(resume_from_, {});
  }
  if (file.empty() || solve.options.glossy) {
    return;
  }
  try {
    Checkpoint(file, *solve.scene, solve.options, solve.total).resume(session);
  } catch (const InputError&) {
    const std::lock_guard lock(mutex_);
    if (session.in_rounds() && resume_from_.empty()) {
      resume_from_ = file;
      return;
    }
  } catch (...) {
    remove(file);
    throw;
  }
  remove(file);
}

void CheckpointKeeper::begin(Solve solve) {
  const std::lock_guard lock(mutex_);
  remove(file_);
  solve_ = std::move(solve);
  plan_.clear();
  since_ = std::chrono::steady_clock::now();
  checkpoint_.reset();
}

void CheckpointKeeper::begin_stage(const TotalPlan& plan) {
  std::ostringstream state;
  plan.save(state);
  const std::lock_guard lock(mutex_);
  plan_ = state.str();
  if (checkpoint_) {
    checkpoint_->set_total_plan(plan_);
  }
}

void CheckpointKeeper::save_if_due(const SolveSession& session, bool in_pause) {
  const std::lock_guard lock(mutex_);
  const bool soon = in_pause || session.progress().direction == 0;
  const double interval = soon ? soon_fraction * interval_ : interval_;
  const std::chrono::duration<double> age = std::chrono::steady_clock::now() - since_;
  if (file_.empty() || !solve_.scene || session.diffuse() == nullptr || age.count() < interval) {
    return;
  }
  try {
    if (!checkpoint_) {
      checkpoint_.emplace(file_, *solve_.scene, solve_.options, solve_.total);
      checkpoint_->set_total_plan(plan_);
      checkpoint_->save(session);
    } else {
      checkpoint_->save_if_due(session, interval);
    }
  } catch (const std::exception&) {
  }
}

}  // namespace transillum::viewer
