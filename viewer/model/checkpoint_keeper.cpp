// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/checkpoint_keeper.h"

#include <chrono>
#include <utility>

namespace transillum::viewer {

namespace {

constexpr double soon_share = 1.0 / 12;

void remove(const std::string& file) {
  if (!file.empty()) {
    const RemovedAtEnd removed(file);
  }
}

}  // namespace

void CheckpointKeeper::set_file(std::string file, double interval) {
  const std::lock_guard lock(mutex_);
  remove(file_);
  file_ = std::move(file);
  interval_ = interval;
  checkpoint_.reset();
}

void CheckpointKeeper::begin(std::shared_ptr<const Scene> scene, const SolveOptions& options) {
  const std::lock_guard lock(mutex_);
  remove(file_);
  scene_ = std::move(scene);
  options_ = options;
  since_ = std::chrono::steady_clock::now();
  checkpoint_.reset();
}

void CheckpointKeeper::save_if_due(const RadiositySolver& solver, const AccuracyPlan* plan) {
  save(solver, plan, solver.progress().direction == 0);
}

void CheckpointKeeper::save_soon(const RadiositySolver& solver, const AccuracyPlan* plan) {
  save(solver, plan, true);
}

void CheckpointKeeper::save(const RadiositySolver& solver, const AccuracyPlan* plan, bool soon) {
  const std::lock_guard lock(mutex_);
  const double interval = soon ? soon_share * interval_ : interval_;
  const std::chrono::duration<double> age = std::chrono::steady_clock::now() - since_;
  if (file_.empty() || !scene_ || age.count() < interval) {
    return;
  }
  try {
    if (!checkpoint_) {
      checkpoint_.emplace(file_, *scene_, options_);
      checkpoint_->save(solver, plan);
    } else {
      checkpoint_->save_if_due(solver, plan, interval);
    }
  } catch (const std::exception&) {
  }
}

}  // namespace transillum::viewer
