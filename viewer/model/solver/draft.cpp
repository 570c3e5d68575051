// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/draft.h"

#include <utility>
#include <vector>

#include "transillum/glossy.h"

namespace transillum::viewer {

namespace {

constexpr int draft_directions = 64;
/// A draft is made where the solve takes at least so many times as many directions.
constexpr int least_ratio = 4;
constexpr PatchId most_patches = 20'000;
/// Bound of the light that is not propagated yet. The last iteration leaves far less: the error, of
/// the few directions, is the same in four digits as with a quarter of this.
constexpr double draft_tolerance = 2e-2;
/// ShotOptions::points of a draft that makes its own first shot: the error of the shot is then
/// still below the error of the few directions.
constexpr int draft_points = 4;

std::shared_ptr<const DirectLight> shoot_few_points(const SolveOptions& options, const Scene& scene,
                                                    const Cancellation& cancellation) {
  if (!options.used_first_shot()) {
    return nullptr;
  }
  const std::vector<PatchId> sources = first_shot_sources(
      scene, *options.first_shot, options.directions, options.basis, cancellation);
  ShotOptions shot = shot_options(options);
  shot.points = draft_points;
  return sources.empty()
             ? nullptr
             : std::make_shared<const DirectLight>(shoot(scene, sources, shot, cancellation));
}

}  // namespace

bool can_be_drafted(const SolveOptions& options, const Scene& scene) {
  const bool is_large = options.goal.is_set() || traits_of(options.scheme).renews_directions ||
                        options.directions >= least_ratio * draft_directions;
  return is_large && !(options.glossy && has_lobes(scene)) && takes_directions(options.engine) &&
         scene.patch_count() <= most_patches;
}

Draft prepare_draft(SolveOptions options, const LoadedScene& loaded,
                    std::shared_ptr<const DirectLight> shot, const Cancellation& cancellation) {
  options.goal = {};
  options.directions = draft_directions;
  options.replicas = 1;
  options.scheme = Scheme::fixed;
  options.burn_in.reset();
  options.iterations = options.averaged_iterations = 0;
  options.tolerance = draft_tolerance;
  if (!options.first_shot) {
    options.first_shot = first_shot_where_it_pays;
  }
  options.validate();
  if (!shot) {
    shot = shoot_few_points(options, *loaded.scene, cancellation);
  }
  std::vector<LinearTerm> slopes;
  if (shot && !shot->linear_terms.empty()) {
    options.basis = Basis::constant;
    auto constant = std::make_shared<DirectLight>(*shot);
    slopes = std::exchange(constant->linear_terms, {});
    constant->linear_term_errors.clear();
    for (DirectLight::Contribution& contribution : constant->contributions) {
      contribution.linear_terms.clear();
    }
    shot = std::move(constant);
  }
  Draft draft{SolveSession({.scene = loaded.scene,
                            .options = std::move(options),
                            .tree = loaded.tree,
                            .shot = std::move(shot)},
                           cancellation),
              std::move(slopes)};
  draft.session.prepare();
  return draft;
}

Solution Draft::solution() const {
  Solution light = session.solution();
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const Rgb& rho = session.scene()->reflectance(static_cast<PatchId>(i));
    light.linear_terms.push_back({rho * slopes[i].first, rho * slopes[i].second});
  }
  return light;
}

void show_light_of(const Solution& solution, SolverSnapshot& snapshot) {
  static_cast<SolvedLight&>(snapshot) = solution;
  if (!snapshot.linear_terms.empty() && !snapshot.bases) {
    snapshot.bases =
        std::make_shared<const std::vector<LinearBasis>>(linear_bases(*snapshot.loaded->scene));
  }
  snapshot.of_draft = true;
}

}  // namespace transillum::viewer
