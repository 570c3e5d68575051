// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <utility>

#include "radiosity/solver/solver_state.h"

namespace transillum {

RadiositySolver::RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                                 SolverResources resources, const Cancellation& cancellation)
    : impl_(std::make_unique<Impl>(
          SolverInput(std::move(scene), options, std::move(resources), cancellation))) {}
RadiositySolver::~RadiositySolver() = default;
RadiositySolver::RadiositySolver(RadiositySolver&&) noexcept = default;
RadiositySolver& RadiositySolver::operator=(RadiositySolver&&) noexcept = default;

bool RadiositySolver::advance(Until until, const Observer& observer) {
  Impl& s = *impl_;
  while (!s.history.finished()) {
    s.input.throw_if_canceled();
    if (!s.iteration.begun) {
      s.begin_iteration();
    }
    if (s.passes_done() < s.passes_needed()) {
      const int last = until == Until::direction ? s.passes_done() + 1 : s.passes_needed();
      const bool go_on = s.advance_passes(last, *this, observer);
      if (s.passes_done() < s.passes_needed() && (!go_on || until == Until::direction)) {
        return true;
      }
    }
    s.finish_iteration();
    const bool stop = s.owned.sums->any(observer && !observer(*this));
    if (stop || until != Until::finished) {
      break;
    }
  }
  return !s.history.finished();
}

const Scene& RadiositySolver::scene() const { return *impl_->input.scene; }
std::shared_ptr<const Scene> RadiositySolver::shared_scene() const { return impl_->input.scene; }
const BspTree& RadiositySolver::tree() const { return *impl_->input.tree; }
std::shared_ptr<const BspTree> RadiositySolver::shared_tree() const { return impl_->input.tree; }
const SolveOptions& RadiositySolver::options() const { return impl_->input.options; }
std::shared_ptr<const DirectLight> RadiositySolver::direct_light() const {
  return impl_->input.shot;
}

void RadiositySolver::complete_estimate() const { impl_->complete(); }

void RadiositySolver::add_replica() { impl_->add_replica(); }
void RadiositySolver::keep_form_factors() { impl_->kept.request(); }

const std::vector<Vec3>& RadiositySolver::directions() const { return impl_->iteration.directions; }

const std::vector<Rgb>& RadiositySolver::radiosity() const { return impl_->history.patch_b(); }
const std::vector<Rgb>& RadiositySolver::irradiance() const { return impl_->history.patch_h(); }
const std::vector<double>& RadiositySolver::estimate_changes() const {
  return impl_->iteration.changes;
}
const std::vector<double>& RadiositySolver::quadrature_errors() const {
  return impl_->statistics.quadrature_errors();
}
std::vector<Rgb> RadiositySolver::running_estimate() const {
  return impl_->input.unknowns->means(impl_->iteration.estimate);
}

Vec3 RadiositySolver::direction(int iteration, int pass) const {
  const Impl& s = *impl_;
  const auto k = static_cast<std::size_t>(pass);
  return s.plan.renews() ? s.plan.directions(iteration).at(k) : s.iteration.directions.at(k);
}

std::vector<Vec3> RadiositySolver::directions_of(int iteration) const {
  return impl_->plan.renews() ? impl_->plan.directions(iteration) : impl_->iteration.directions;
}

int RadiositySolver::passes_of(int iteration) const { return impl_->plan.passes(iteration); }

}  // namespace transillum
