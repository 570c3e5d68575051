// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/session_snapshot.h"

#include <new>
#include <utility>

#include "model/snapshot_values.h"

namespace transillum::viewer {

SolverSnapshot snapshot_of(const SolveSession& session, std::shared_ptr<const LoadedScene> loaded) {
  SolverSnapshot snapshot;
  snapshot.loaded = std::move(loaded);
  snapshot.options = session.options();
  snapshot.progress = session.progress();
  snapshot.passes_done = session.passes_done();
  snapshot.of_file = snapshot.loaded->stored && snapshot.passes_done == 0;
  const RadiositySolver* diffuse = session.diffuse();
  Solution solution = diffuse != nullptr ? diffuse->solution() : session.glossy()->solution();
  solution.statistics = session.statistics();
  const std::shared_ptr<const GlossyLight> glossy = solution.glossy;
  if (snapshot.of_file) {
    solution = *snapshot.loaded->stored;
  } else {
    snapshot.uncertain_patches = std::ssize(uncertain_patches(solution));
  }
  snapshot.statistics = std::move(solution.statistics);
  snapshot.error = std::move(solution.error);
  static_cast<SolvedLight&>(snapshot) = std::move(solution);
  snapshot.glossy = glossy;
  // Empty before the first pass.
  snapshot.form_factor_sums.resize(snapshot.radiosity.size());
  if (!snapshot.of_file) {
    snapshot.sky_fractions.resize(snapshot.radiosity.size());
  }
  if (diffuse != nullptr) {
    snapshot.shot = diffuse->direct_light();
    snapshot.estimate_changes = diffuse->estimate_changes();
    snapshot.quadrature_errors = diffuse->quadrature_errors();
  }
  std::optional<AccuracyReport> accuracy = session.accuracy();
  if (accuracy && !accuracy->stages.empty()) {
    snapshot.accuracy = std::move(accuracy);
  }
  return snapshot;
}

namespace {

// Limit for all directions; later ones are not stored.
constexpr std::size_t most_kept_bytes = std::size_t{256} << 20;
// Limit for all B(n) together: with it, the window needs at most 250 MB and 1.1 times the memory of
// the command line. Beyond it, only the newest two are stored, for the last change.
constexpr std::size_t most_radiosity_bytes = std::size_t{8} << 20;

template <class Value>
std::shared_ptr<const std::vector<Value>> shared(std::vector<Value> values) {
  return std::make_shared<const std::vector<Value>>(std::move(values));
}

/// The linear terms of B(0): what the first shot brings. E has none.
std::vector<LinearTerm> parts_of_start(const SolveSession& session) {
  const Scene& scene = *session.scene();
  std::vector<LinearTerm> parts(scene.patches().size());
  const std::vector<LinearTerm>& shot = session.diffuse()->direct_light()->linear_terms;
  for (std::size_t i = 0; i < shot.size(); ++i) {
    const Rgb& rho = scene.reflectance(static_cast<PatchId>(i));
    parts[i] = {rho * shot[i].first, rho * shot[i].second};
  }
  return parts;
}

}  // namespace

SolveHistory::SolveHistory(const SolveSession& session)
    : directions_{shared(session.directions_of(0))},
      passes_{session.passes_of(0)},
      replicas_(session.options().replicas) {
  update(session);
}

void SolveHistory::update(const SolveSession& session) {
  store_radiosity(session);
  store_directions(session);
  store_errors(session);
  const SolveProgress progress = session.progress();
  if (progress.direction == progress.passes) {
    // The solver clears them at the end of the iteration.
    changes_ = session.estimate_changes();
    changes_iteration_ = progress.iteration;
  }
}

void SolveHistory::store_radiosity(const SolveSession& session) {
  const SolveProgress progress = session.progress();
  const auto iteration = static_cast<std::size_t>(progress.iteration);
  if (iteration < radiosity_.size()) {
    return;
  }
  std::vector<Rgb> radiosity = session.radiosity();
  const std::size_t patches = radiosity.size();
  radiosity_.resize(iteration + 1);
  const bool linear = session.options().basis == Basis::linear;
  const std::size_t bytes = patches * sizeof(Rgb) * (linear ? 3 : 1);
  radiosity_[iteration] = shared(std::move(radiosity));
  if (linear) {
    linear_terms_.resize(iteration + 1);
  }
  if (iteration >= 2 && bytes * (iteration - 1) > most_radiosity_bytes) {
    radiosity_[iteration - 2] = nullptr;
    if (linear) {
      linear_terms_[iteration - 2] = nullptr;
    }
  }
  if (!linear) {
    return;
  }
  if (iteration == 0) {
    // The solver's parts may already belong to the estimate.
    linear_terms_[0] = shared(parts_of_start(session));
  } else if (progress.direction == 0) {
    linear_terms_[iteration] = shared(session.linear_terms());
  }
}

void SolveHistory::store_directions(const SolveSession& session) {
  const SolveOptions& options = session.options();
  if (options.replicas > replicas_) {
    directions_.front() = shared(session.directions());
    replicas_ = options.replicas;
  }
  const SolveProgress progress = session.progress();
  const std::size_t begun =
      static_cast<std::size_t>(progress.iteration) + (progress.direction > 0 ? 1 : 0);
  while (directions_.size() < begun) {
    const auto iteration = static_cast<int>(directions_.size());
    if (options.scheme != Scheme::semi_iterative) {
      directions_.push_back(directions_.front());
    } else if (session.directions().size() * begun * sizeof(Vec3) <= most_kept_bytes) {
      directions_.push_back(shared(session.directions_of(iteration)));
    } else {
      directions_.push_back(nullptr);
    }
    passes_.push_back(session.passes_of(iteration));
  }
}

void SolveHistory::store_errors(const SolveSession& session) {
  const SolveProgress progress = session.progress();
  const auto iterations = static_cast<std::size_t>(progress.iteration);
  if (session.options().replicas < 2 || errors_.size() >= iterations || progress.direction > 0) {
    return;
  }
  const ErrorEstimate error = session.error_estimate();
  errors_.resize(iterations);  // iterations that were not observed have 0
  errors_.back() = {error.rms_lowest, error.rms, error.rms_limit};
}

void SolveHistory::write_to(SolverSnapshot& snapshot) {
  snapshot.kept_directions = directions_;
  snapshot.directions = directions_.back();
  snapshot.kept_passes = passes_;
  snapshot.kept_radiosity = radiosity_;
  snapshot.kept_linear_terms = linear_terms_;
  snapshot.errors = errors_;
  snapshot.estimate_iteration = snapshot.progress.iteration;
  if (snapshot.estimate_changes.empty() && snapshot.progress.iteration > 0) {
    snapshot.estimate_changes = changes_;
    snapshot.estimate_iteration = changes_iteration_;
  }
  if (!snapshot.linear_terms.empty()) {
    if (!bases_) {
      bases_ = shared(linear_bases(*snapshot.loaded->scene));
    }
    snapshot.bases = bases_;
    snapshot.statistics.negative_corners = count_negative_corners(snapshot);
  }
}

namespace {

// Limit for the form factors in addition to the solver's sums.
constexpr std::int64_t most_bytes = std::int64_t{1} << 30;
constexpr std::int64_t bytes_per_entry = sizeof(PatchId) + sizeof(double);

}  // namespace

bool KeptFormFactors::can_assemble(const SolveSession& session) const {
  const SolveProgress progress = session.progress();
  const bool between_iterations = progress.direction == 0 && progress.iteration > 0;
  return requested_ && between_iterations && fit_ && session.diffuse() != nullptr;
}

bool KeptFormFactors::are_due(const SolveSession& session) const {
  return can_assemble(session) && session.statistics().passes_made >= 2 * passes_;
}

void KeptFormFactors::update(const SolveSession& session) {
  if (!can_assemble(session)) {
    return;
  }
  const SolveStatistics statistics = session.statistics();
  if (statistics.passes_made == passes_) {
    return;
  }
  const int directions_per_pass = session.options().two_way ? 2 : 1;
  factors_ = nullptr;
  fit_ = statistics.kept_form_factors &&
         directions_per_pass * statistics.form_factors * bytes_per_entry <= most_bytes;
  if (!fit_) {
    return;
  }
  try {
    factors_ = std::make_shared<const FormFactors>(session.diffuse()->form_factors());
    passes_ = statistics.passes_made;
  } catch (const std::bad_alloc&) {
    fit_ = false;
  }
}

void KeptFormFactors::write_to(SolverSnapshot& snapshot) const {
  snapshot.form_factors = factors_;
  snapshot.form_factors_fit = fit_;
}

void KeptFormFactors::clear() {
  factors_ = nullptr;
  passes_ = 0;
  fit_ = true;
}

}  // namespace transillum::viewer
