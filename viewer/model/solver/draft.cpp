// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/solver/draft.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "transillum/at.h"
#include "transillum/glossy.h"
#include "transillum/linear_basis.h"

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

/// The largest factor up to 1 of a term with which the light is below 0 in no corner of patch i:
/// the best linear function of a patch half in a shadow is, and a black corner shows.
double factor_above_zero(const LinearTerm& term, const Rgb& mean, const Scene& scene, PatchId i) {
  const LinearBasis basis = linear_basis(scene, i);
  double factor = 1;
  for (const PointId corner : scene.outline(i)) {
    const auto [u, v] = basis.at(scene.point(corner));
    const Rgb slope = u * term.first + v * term.second;
    for (double Rgb::*channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
      if (mean.*channel + factor * slope.*channel < 0) {
        factor = std::clamp(mean.*channel / -(slope.*channel), 0.0, factor);
      }
    }
  }
  return factor;
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
  const Scene& scene = *session.scene();
  for (PatchId i = 0; i < std::ssize(slopes); ++i) {
    const Rgb& rho = scene.reflectance(i);
    const LinearTerm term{rho * at(slopes, i).first, rho * at(slopes, i).second};
    const double factor = factor_above_zero(term, at(light.radiosity, i), scene, i);
    light.linear_terms.push_back({factor * term.first, factor * term.second});
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
