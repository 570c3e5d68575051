// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What both kinds of solver have, by one name.
#include "session/running_solver.h"

namespace transillum {

bool RunningSolver::advance(RadiositySolver::Until until, const std::function<bool()>& observer) {
  RadiositySolver* const solver = diffuse();
  return solver != nullptr
             ? solver->advance(until, [&](const RadiositySolver&) { return observer(); })
             : glossy()->advance(until, [&](const SolveProgress&) { return observer(); });
}

const SolveOptions& RunningSolver::options() const {
  return diffuse() != nullptr ? diffuse()->options() : glossy()->options();
}

SolveProgress RunningSolver::progress() const {
  return diffuse() != nullptr ? diffuse()->progress() : glossy()->progress();
}

SolveStatistics RunningSolver::statistics() const {
  return diffuse() != nullptr ? diffuse()->statistics() : glossy()->solution().statistics;
}

const std::vector<Vec3>& RunningSolver::directions() const {
  return diffuse() != nullptr ? diffuse()->directions() : glossy()->directions();
}

std::vector<Vec3> RunningSolver::directions_of(int iteration) const {
  return diffuse() != nullptr ? diffuse()->directions_of(iteration) : glossy()->directions();
}

int RunningSolver::passes_of(int iteration) const {
  return diffuse() != nullptr ? diffuse()->passes_of(iteration)
                              : static_cast<int>(glossy()->directions().size());
}

std::vector<Rgb> RunningSolver::radiosity() const {
  return diffuse() != nullptr ? diffuse()->radiosity() : glossy()->solution().radiosity;
}

ErrorEstimate RunningSolver::error_estimate() const {
  return diffuse() != nullptr ? diffuse()->error_estimate() : glossy()->error_estimate();
}

Solution RunningSolver::solution() const {
  return diffuse() != nullptr ? diffuse()->solution() : glossy()->solution();
}

}  // namespace transillum
