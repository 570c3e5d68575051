// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/running_solver.h"

#include <utility>

namespace transillum::viewer {

std::unique_ptr<RunningSolver> RunningSolver::make(const LoadedScene& loaded,
                                                   const SolveOptions& options,
                                                   const Cancellation& cancellation) {
  if (options.glossy && has_lobes(*loaded.scene)) {
    return std::make_unique<RunningSolver>(
        std::make_unique<GlossySolver>(loaded.scene, options, loaded.tree, cancellation));
  }
  return std::make_unique<RunningSolver>(
      std::make_unique<RadiositySolver>(loaded.scene, options, loaded.tree, cancellation));
}

bool RunningSolver::advance(Until until, const std::function<bool()>& observer) {
  return diffuse_ ? diffuse_->advance(until, [&](const RadiositySolver&) { return observer(); })
                  : glossy_->advance(until, [&](const SolveProgress&) { return observer(); });
}

const SolveOptions& RunningSolver::options() const {
  return diffuse_ ? diffuse_->options() : glossy_->options();
}

SolveProgress RunningSolver::progress() const {
  return diffuse_ ? diffuse_->progress() : glossy_->progress();
}

SolveStatistics RunningSolver::statistics() const {
  return diffuse_ ? diffuse_->statistics() : glossy_->solution().statistics;
}

const std::vector<Vec3>& RunningSolver::directions() const {
  return diffuse_ ? diffuse_->directions() : glossy_->directions();
}

std::vector<Vec3> RunningSolver::directions_of(int iteration) const {
  return diffuse_ ? diffuse_->directions_of(iteration) : glossy_->directions();
}

int RunningSolver::passes_of(int iteration) const {
  return diffuse_ ? diffuse_->passes_of(iteration) : static_cast<int>(glossy_->directions().size());
}

std::vector<Rgb> RunningSolver::radiosity() const {
  return diffuse_ ? diffuse_->radiosity() : glossy_->solution().radiosity;
}

std::vector<LinearPart> RunningSolver::linear_parts() const {
  return diffuse_ ? diffuse_->linear_parts() : std::vector<LinearPart>();
}

std::vector<double> RunningSolver::estimate_changes() const {
  return diffuse_ ? diffuse_->estimate_changes() : std::vector<double>();
}

ErrorEstimate RunningSolver::error_estimate() const {
  return diffuse_ ? diffuse_->error_estimate() : ErrorEstimate();
}

void RunningSolver::write_to(SolverSnapshot& snapshot) const {
  snapshot.options = options();
  snapshot.progress = progress();
  if (glossy_) {
    Solution solution = glossy_->solution();
    snapshot.statistics = std::move(solution.statistics);
    snapshot.radiosity = std::move(solution.radiosity);
    snapshot.irradiance = std::move(solution.irradiance);
    snapshot.glossy = std::move(solution.glossy);
    snapshot.form_factor_sums = std::move(solution.form_factor_sums);
    snapshot.sky_shares = std::move(solution.sky_shares);
    snapshot.sky_irradiance = std::move(solution.sky_irradiance);
    const std::size_t patches = snapshot.radiosity.size();
    snapshot.form_factor_sums.resize(patches);  // empty before the first pass
    snapshot.sky_shares.resize(patches);
    return;
  }
  snapshot.statistics = diffuse_->statistics();
  snapshot.radiosity = diffuse_->running_estimate();
  snapshot.linear_parts = diffuse_->linear_parts();
  snapshot.irradiance = diffuse_->irradiance();
  snapshot.shot = diffuse_->direct_light();
  snapshot.form_factor_sums = diffuse_->form_factor_sums();
  snapshot.sky_shares = diffuse_->sky_shares();
  snapshot.sky_irradiance = diffuse_->sky_irradiance();
  snapshot.estimate_changes = diffuse_->estimate_changes();
  snapshot.quadrature_errors = diffuse_->quadrature_errors();
  snapshot.error = diffuse_->error_estimate();
}

}  // namespace transillum::viewer
