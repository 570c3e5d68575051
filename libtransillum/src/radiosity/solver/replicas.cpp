// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/replicas.h"

#include <algorithm>

namespace transillum {

Replicas::Replicas(const SolverInput& input) {
  if (input.options.replicas < 2) {
    return;
  }
  surfaces_ = ErrorSurfaces(*input.scene, input.options.goal.surfaces);
  for (int r = 0; r < input.options.replicas; ++r) {
    iterates_.emplace_back(*input.unknowns, input.options, input.owned());
  }
  means_.resize(iterates_.size());
}

void Replicas::add_replica(const SolverInput& input, const RadiosityIterate& whole) {
  iterates_.emplace_back(*input.unknowns, input.options, input.owned());
  iterates_.back().start_from(whole);
  means_.emplace_back();
}

void Replicas::add(std::size_t r, const Transfers& transfers) {
  if (!iterates_.empty()) {
    iterates_[r].add(transfers);
  }
}

void Replicas::finish() {
  for (RadiosityIterate& iterate : iterates_) {
    iterate.finish();
  }
}

void Replicas::add_to_means() {
  for (std::size_t r = 0; r < iterates_.size(); ++r) {
    means_[r].add(iterates_[r].b());
  }
}

ErrorEstimate Replicas::error_estimate(const Scene& scene, const std::vector<Rgb>& b,
                                       const std::vector<Rgb>& h, Radiosity kind) const {
  const bool incomplete = kind == Radiosity::running_estimate &&
                          std::any_of(iterates_.begin(), iterates_.end(),
                                      [](const auto& iterate) { return iterate.passes() == 0; });
  if (iterates_.empty() || incomplete) {
    return {};
  }
  std::vector<std::vector<Rgb>> radiosities;
  for (std::size_t r = 0; r < iterates_.size(); ++r) {
    radiosities.push_back(radiosity(r, kind));
  }
  ErrorEstimate error = estimate_error(scene, surfaces_, b, radiosities);
  if (kind == Radiosity::finished_iteration) {
    for (std::size_t r = 0; r < iterates_.size(); ++r) {
      radiosities[r] = iterates_[r].h();
    }
    error.irradiance = surface_errors(surfaces_.receiving, h, radiosities);
  }
  return error;
}

std::vector<Rgb> Replicas::radiosity(std::size_t r, Radiosity kind) const {
  if (kind == Radiosity::mean) {
    return means_[r].mean();
  }
  std::vector<Rgb> b = iterates_[r].b();
  if (kind == Radiosity::running_estimate) {
    for (std::size_t u = 0; u < b.size(); ++u) {
      b[u] = iterates_[r].estimate(u);
    }
  }
  return b;
}

}  // namespace transillum
