// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <utility>

#include "radiosity/solver/solver_state.h"

namespace transillum {

RadiositySolver::RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                                 std::shared_ptr<const BspTree> tree,
                                 const Cancellation& cancellation,
                                 std::shared_ptr<const DirectLight> shot)
    : impl_(std::make_unique<Impl>(std::move(scene), options, std::move(tree), cancellation,
                                   std::move(shot))) {}
RadiositySolver::~RadiositySolver() = default;
RadiositySolver::RadiositySolver(RadiositySolver&&) noexcept = default;
RadiositySolver& RadiositySolver::operator=(RadiositySolver&&) noexcept = default;

bool RadiositySolver::advance(Until until, const Observer& observer) {
  Impl& s = *impl_;
  while (!s.finished) {
    s.cancellation.throw_if_canceled();
    if (!s.begun) {
      s.begin_step();
    }
    if (s.done() < s.wanted()) {
      const bool go_on = until == Until::direction ? s.advance_direction(*this, observer)
                                                   : s.advance_passes(*this, observer);
      if (s.done() < s.wanted() && (!go_on || until == Until::direction)) {
        return true;
      }
    }
    s.finish_step();
    const bool go_on = !observer || observer(*this);
    if (!go_on || until != Until::finished) {
      break;
    }
  }
  return !s.finished;
}

const Scene& RadiositySolver::scene() const { return *impl_->scene; }
std::shared_ptr<const Scene> RadiositySolver::shared_scene() const { return impl_->scene; }
const BspTree& RadiositySolver::tree() const { return *impl_->tree; }
std::shared_ptr<const BspTree> RadiositySolver::shared_tree() const { return impl_->tree; }
const SolveOptions& RadiositySolver::options() const { return impl_->options; }
std::shared_ptr<const DirectLight> RadiositySolver::direct_light() const { return impl_->shot; }

void RadiositySolver::keep_form_factors() { impl_->keeps_renewed = true; }

const std::vector<Vec3>& RadiositySolver::directions() const { return impl_->directions; }

const std::vector<Rgb>& RadiositySolver::radiosity() const { return impl_->b; }
const std::vector<Rgb>& RadiositySolver::irradiance() const { return impl_->h; }
const std::vector<double>& RadiositySolver::estimate_changes() const {
  return impl_->estimate_changes;
}
const std::vector<double>& RadiositySolver::quadrature_errors() const {
  return impl_->quadrature_errors;
}
std::vector<Rgb> RadiositySolver::running_estimate() const { return impl_->estimate; }

Vec3 RadiositySolver::direction(int iteration, int pass) const {
  const Impl& s = *impl_;
  const auto k = static_cast<std::size_t>(pass);
  return s.plan.renews() ? s.plan.directions(iteration).at(k) : s.directions.at(k);
}

Solution solve(std::shared_ptr<const Scene> scene, const SolveOptions& options,
               const RadiositySolver::Observer& observer, const Cancellation& cancellation) {
  const auto start = std::chrono::steady_clock::now();
  RadiositySolver solver(std::move(scene), options, nullptr, cancellation);
  Solution solution;
  solution.scene = solver.shared_scene();
  try {
    while (solver.advance(RadiositySolver::Until::finished, observer)) {
      // A pause asked for by the observer of a plain solve is the end of it.
      if (observer) {
        break;
      }
    }
  } catch (const Canceled&) {
  }
  const SolveProgress progress = solver.progress();
  solution.complete = progress.finished;
  solution.radiosity = progress.direction > 0 ? solver.running_estimate() : solver.radiosity();
  solution.irradiance = solver.irradiance();
  solution.error = solver.error_estimate();
  solution.statistics = solver.statistics();
  solution.statistics.seconds_total = seconds_since(start);
  return solution;
}

}  // namespace transillum
