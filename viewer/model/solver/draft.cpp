// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/draft.h"

#include <utility>

#include "transillum/errors.h"

namespace transillum::viewer {

namespace {

constexpr int draft_directions = 64;
/// A draft is made where the solve takes at least so many times as many directions.
constexpr int least_ratio = 4;
constexpr PatchId most_patches = 20'000;
/// Bound of the light that is not propagated yet: far below the error of so few directions.
constexpr double draft_tolerance = 1e-3;

std::optional<SolveOptions> draft_of(const SolveSession& session) {
  SolveOptions options = session.options();
  const bool is_large = options.goal.is_set() || traits_of(options.scheme).renews_directions ||
                        options.directions >= least_ratio * draft_directions;
  if (!is_large || session.diffuse() == nullptr || !takes_directions(options.engine) ||
      session.scene()->patch_count() > most_patches) {
    return std::nullopt;
  }
  options.goal = {};
  options.directions = draft_directions;
  options.replicas = 1;
  options.scheme = Scheme::fixed;
  options.burn_in.reset();
  options.iterations = options.averaged_iterations = 0;
  options.tolerance = draft_tolerance;
  options.first_shot = first_shot_where_it_pays;
  return options;
}

}  // namespace

std::optional<Solution> make_draft(const SolveSession& session,
                                   const std::function<bool()>& continues,
                                   const Cancellation& cancellation) {
  const std::optional<SolveOptions> options = draft_of(session);
  if (!options) {
    return std::nullopt;
  }
  try {
    SolveSession draft({.scene = session.scene(), .options = *options, .tree = session.tree()},
                       cancellation);
    draft.advance(SolveSession::Until::finished, [&](const SolveSession&) { return continues(); });
    return draft.finished() ? std::optional(draft.solution()) : std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;  // some options go with many directions only
  } catch (const NotConvergent&) {
    return std::nullopt;
  }
}

void show_light_of(const Solution& solution, SolverSnapshot& snapshot) {
  static_cast<SolvedLight&>(snapshot) = solution;
  snapshot.of_draft = true;
}

}  // namespace transillum::viewer
