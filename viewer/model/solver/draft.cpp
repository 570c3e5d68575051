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
/// Bound of the light that is not propagated yet. The last iteration leaves far less: the error, of
/// the few directions, is the same in four digits as with a quarter of this.
constexpr double draft_tolerance = 2e-2;
/// ShotOptions::points of a draft that makes its own first shot: the error of the shot is then
/// still below the error of the few directions.
constexpr int draft_points = 4;

/// Takes the first shot out of the options where it does not pay, so that the session does not ask
/// again: that takes most of the time in a scene of a few patches.
std::shared_ptr<const DirectLight> shoot_few_points(SolveOptions& options, const Scene& scene,
                                                    const Cancellation& cancellation) {
  if (!options.used_first_shot()) {
    return nullptr;
  }
  const std::vector<PatchId> sources = first_shot_sources(
      scene, *options.first_shot, options.directions, options.basis, cancellation);
  if (sources.empty()) {
    options.first_shot.reset();
    return nullptr;
  }
  ShotOptions shot = shot_options(options);
  shot.points = draft_points;
  return std::make_shared<const DirectLight>(shoot(scene, sources, shot, cancellation));
}

/// The same patches, whose lobes reflect diffusely.
std::shared_ptr<const Scene> without_lobes(const Scene& scene) {
  std::vector<Material> materials = scene.materials();
  for (Material& material : materials) {
    material.reflectance = material.reflectance + used_lobe(material).reflectance;
    material.lobe = {};
  }
  std::vector<std::int32_t> of_patch;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    of_patch.push_back(scene.patch(i).material);
  }
  return std::make_shared<const Scene>(scene, std::move(materials), of_patch);
}

/// The patches with a common corner in the same plane, by PatchId; ascending.
std::vector<std::vector<PatchId>> neighbors_of(const Scene& scene) {
  constexpr double same_plane = 1 - 1e-6;
  std::vector<std::vector<PatchId>> around(scene.points().size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    for (const PointId corner : scene.outline(i)) {
      at(around, corner).push_back(i);
    }
  }
  std::vector<std::vector<PatchId>> neighbors(static_cast<std::size_t>(scene.patch_count()));
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    std::vector<PatchId>& found = at(neighbors, i);
    for (const PointId corner : scene.outline(i)) {
      for (const PatchId j : at(around, corner)) {
        if (j != i && dot(scene.patch(i).normal, scene.patch(j).normal) > same_plane) {
          found.push_back(j);
        }
      }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
  }
  return neighbors;
}

/// The linear function about `mean` that fits the means of the neighbors best, by least squares; it
/// has no slope in a direction without neighbors.
LinearTerm fitted_term(const LinearBasis& basis, const Rgb& mean,
                       const std::vector<PatchId>& neighbors, const std::vector<LinearBasis>& bases,
                       const std::vector<Rgb>& means) {
  constexpr double regular = 1e-6;
  double uu = 0, uv = 0, vv = 0;
  Rgb by_u, by_v;
  for (const PatchId j : neighbors) {
    const auto [u, v] = basis.at(at(bases, j).center);
    const Rgb rise = at(means, j) - mean;
    uu += u * u, uv += u * v, vv += v * v;
    by_u += u * rise, by_v += v * rise;
  }
  const double added = regular * (uu + vv);
  uu += added, vv += added;
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) {
    return {};
  }
  return {1 / determinant * (vv * by_u - uv * by_v), 1 / determinant * (uu * by_v - uv * by_u)};
}

/// The largest factor up to 1 of a term with which the light is below 0 in no corner of patch i: a
/// black corner shows.
double factor_above_zero(const LinearTerm& term, const LinearBasis& basis, const Rgb& mean,
                         const Scene& scene, PatchId i) {
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

bool is_better_than_draft(const SolveStatistics& statistics) {
  return statistics.passes >= least_ratio * draft_directions;
}

bool can_be_drafted(const SolveOptions& options, const Scene& scene) {
  const bool is_large = options.goal.is_set() || traits_of(options.scheme).renews_directions ||
                        options.directions >= least_ratio * draft_directions;
  return is_large && takes_directions(options.engine) && scene.patch_count() <= most_fitted_patches;
}

SolveSession prepare_draft(SolveOptions options, const LoadedScene& loaded,
                           std::shared_ptr<const DirectLight> shot,
                           const Cancellation& cancellation) {
  const bool glossy = std::exchange(options.glossy, false) && has_lobes(*loaded.scene);
  const auto scene = glossy ? without_lobes(*loaded.scene) : loaded.scene;
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
  options.basis = Basis::constant;
  options.validate();
  if (!shot) {
    shot = shoot_few_points(options, *scene, cancellation);
  }
  if (shot && !shot->linear_terms.empty()) {
    auto constant = std::make_shared<DirectLight>(*shot);
    constant->linear_terms.clear();
    constant->linear_term_errors.clear();
    for (DirectLight::Contribution& contribution : constant->contributions) {
      contribution.linear_terms.clear();
    }
    shot = std::move(constant);
  }
  SolveSession draft(
      {.scene = scene, .options = std::move(options), .tree = loaded.tree, .shot = std::move(shot)},
      cancellation);
  draft.prepare();
  return draft;
}

FittedLight fitted_light(const SolvedLight& light, const Scene& scene) {
  FittedLight fitted{{}, std::make_shared<const std::vector<LinearBasis>>(linear_bases(scene))};
  const std::vector<LinearBasis>& bases = *fitted.bases;
  const std::vector<std::vector<PatchId>> neighbors = neighbors_of(scene);
  fitted.terms.reserve(bases.size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const LinearBasis& basis = at(bases, i);
    const LinearTerm h =
        fitted_term(basis, at(light.irradiance, i), at(neighbors, i), bases, light.irradiance);
    const Rgb& rho = scene.reflectance(i);
    const LinearTerm b{rho * h.first, rho * h.second};
    const double factor = factor_above_zero(b, basis, at(light.radiosity, i), scene, i);
    fitted.terms.push_back({factor * b.first, factor * b.second});
  }
  return fitted;
}

Solution smoothed(Solution light) {
  if (light.linear_terms.empty()) {
    light.linear_terms = fitted_light(light, *light.scene).terms;
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
