// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/kept_form_factors.h"

#include <new>

namespace transillum::viewer {

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
