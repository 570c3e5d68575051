// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <memory>
#include <variant>
#include <vector>

#include "transillum/glossy.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/solve_session.h"

namespace transillum {

/// The solver of a stage: a GlossySolver where lobes take part, else a RadiositySolver.
class RunningSolver {
 public:
  explicit RunningSolver(RadiositySolver solver) : solver_(std::move(solver)) {}
  explicit RunningSolver(GlossySolver solver) : solver_(std::move(solver)) {}

  /// Null where lobes take part.
  RadiositySolver* diffuse() { return std::get_if<RadiositySolver>(&solver_); }
  const RadiositySolver* diffuse() const { return std::get_if<RadiositySolver>(&solver_); }
  /// Null where no lobes take part.
  GlossySolver* glossy() { return std::get_if<GlossySolver>(&solver_); }
  const GlossySolver* glossy() const { return std::get_if<GlossySolver>(&solver_); }

  /// The same as RadiositySolver::advance()
  bool advance(RadiositySolver::Until until, const std::function<bool()>& observer);
  const SolveOptions& options() const;
  SolveProgress progress() const;
  SolveStatistics statistics() const;
  const std::vector<Vec3>& directions() const;
  std::vector<Vec3> directions_of(int iteration) const;
  int passes_of(int iteration) const;
  std::vector<Rgb> radiosity() const;
  ErrorEstimate error_estimate() const;
  Solution solution() const;

 private:
  std::variant<RadiositySolver, GlossySolver> solver_;
};

}  // namespace transillum
