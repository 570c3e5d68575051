// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// SolveRunner's worker: what snapshots hold of earlier iterations (directions, B, errors), and the
// linear parts of B.
#include "model/linear_values.h"
#include "model/solve_runner.h"

namespace transillum::viewer {

namespace {

// Limit for all B(n) together, and for all directions; later ones are not stored.
constexpr std::size_t most_kept_bytes = std::size_t{256} << 20;

}  // namespace

/// Directions and numbers of passes of the iterations that the solver has begun.
void SolveRunner::restore_history() {
  kept_directions_ = {std::make_shared<const std::vector<Vec3>>(solver_->directions_of(0))};
  kept_passes_ = {solver_->passes_of(0)};
  store_directions();
}

void SolveRunner::store_radiosity() {
  const auto iteration = static_cast<std::size_t>(solver_->progress().iteration);
  if (iteration < kept_radiosity_.size()) {
    return;
  }
  const std::vector<Rgb> radiosity = solver_->radiosity();
  kept_radiosity_.resize(iteration + 1);
  const bool linear = solver_->options().basis == Basis::linear;
  if (radiosity.size() * (iteration + 1) * sizeof(Rgb) * (linear ? 3 : 1) > most_kept_bytes) {
    return;
  }
  kept_radiosity_[iteration] = std::make_shared<const std::vector<Rgb>>(radiosity);
  if (!linear) {
    return;
  }
  kept_linear_parts_.resize(iteration + 1);
  using Parts = std::vector<LinearPart>;
  if (iteration == 0) {
    // B(0) is E; the solver's parts may be those of the estimate already.
    kept_linear_parts_[0] = std::make_shared<const Parts>(radiosity.size());
  } else if (solver_->progress().direction == 0) {
    kept_linear_parts_[iteration] = std::make_shared<const Parts>(solver_->linear_parts());
  }
}

void SolveRunner::show_linear_parts(SolverSnapshot& snapshot) {
  if (snapshot.linear_parts.empty()) {
    return;
  }
  if (scene_of_bases_ != loaded_->scene) {
    scene_of_bases_ = loaded_->scene;
    bases_ = std::make_shared<const std::vector<LinearBasis>>(linear_bases(*loaded_->scene));
  }
  snapshot.bases = bases_;
  snapshot.statistics.negative_corners = count_negative_corners(snapshot);
}

void SolveRunner::store_errors() {
  const auto iterations = static_cast<std::size_t>(solver_->progress().iteration);
  if (solver_->options().replicas < 2 || errors_.size() >= iterations ||
      solver_->progress().direction > 0) {
    return;
  }
  const ErrorEstimate error = solver_->error_estimate();
  errors_.resize(iterations);  // those of iterations that were not observed are 0
  errors_.back() = {error.rms_lowest, error.rms, error.rms_limit};
}

void SolveRunner::store_directions() {
  const SolveProgress progress = solver_->progress();
  const std::size_t begun =
      static_cast<std::size_t>(progress.iteration) + (progress.direction > 0 ? 1 : 0);
  while (kept_directions_.size() < begun) {
    const auto iteration = static_cast<int>(kept_directions_.size());
    if (solver_->options().scheme != Scheme::semi_iterative) {
      kept_directions_.push_back(kept_directions_.front());
    } else if (solver_->directions().size() * begun * sizeof(Vec3) <= most_kept_bytes) {
      kept_directions_.push_back(
          std::make_shared<const std::vector<Vec3>>(solver_->directions_of(iteration)));
    } else {
      kept_directions_.push_back(nullptr);
    }
    kept_passes_.push_back(solver_->passes_of(iteration));
  }
}

}  // namespace transillum::viewer
