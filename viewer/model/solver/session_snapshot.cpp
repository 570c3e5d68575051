// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/session_snapshot.h"

#include <utility>

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
  snapshot.glossy = std::move(solution.glossy);
  if (snapshot.of_file) {
    solution = *snapshot.loaded->stored;
  } else {
    snapshot.uncertain_patches = std::ssize(uncertain_patches(solution));
  }
  snapshot.statistics = std::move(solution.statistics);
  snapshot.radiosity = std::move(solution.radiosity);
  snapshot.linear_parts = std::move(solution.linear_parts);
  snapshot.irradiance = std::move(solution.irradiance);
  snapshot.error = std::move(solution.error);
  snapshot.form_factor_sums = std::move(solution.form_factor_sums);
  snapshot.sky_shares = std::move(solution.sky_shares);
  snapshot.sky_irradiance = std::move(solution.sky_irradiance);
  // Empty before the first pass.
  snapshot.form_factor_sums.resize(snapshot.radiosity.size());
  if (!snapshot.of_file) {
    snapshot.sky_shares.resize(snapshot.radiosity.size());
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

}  // namespace transillum::viewer
