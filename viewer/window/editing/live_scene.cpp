// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/editing/live_scene.h"

#include <QElapsedTimer>
#include <algorithm>
#include <map>
#include <utility>

#include "model/requests/relighting.h"
#include "model/snapshot_values.h"
#include "model/solver/draft.h"
#include "model/solver/scene_loading.h"
#include "transillum/at.h"
#include "transillum/errors.h"
#include "transillum/glossy.h"

namespace transillum::viewer {

namespace {

/// The mean over the patches of each face, for the patches of another scene.
std::vector<Rgb> by_face(const std::vector<Rgb>& values, const Scene& before, const Scene& after) {
  struct Mean {
    Rgb sum;
    double area = 0;
  };
  std::map<std::int32_t, Mean> means;
  for (PatchId i = 0; i < before.patch_count() && i < std::ssize(values); ++i) {
    Mean& mean = means[before.patch(i).face];
    mean.sum += before.patch(i).area * at(values, i);
    mean.area += before.patch(i).area;
  }
  std::vector<Rgb> spread;
  for (const Patch& patch : after.patches()) {
    const auto found = means.find(patch.face);
    spread.push_back(found == means.end() ? Rgb{} : (1 / found->second.area) * found->second.sum);
  }
  return spread;
}

Rgb difference(const Rgb& a, const Rgb& b) { return a - b; }
LinearTerm difference(const LinearTerm& a, const LinearTerm& b) {
  return {a.first - b.first, a.second - b.second};
}
Rgb sum(const Rgb& a, const Rgb& b) { return a + b; }
LinearTerm sum(const LinearTerm& a, const LinearTerm& b) {
  return {a.first + b.first, a.second + b.second};
}

/// values - removed + added, without rounding where values and removed are equal; empty lists count
/// as 0.
template <class Value>
std::vector<Value> exchanged(std::vector<Value> values, std::vector<Value> removed,
                             std::vector<Value> added) {
  const std::size_t count = std::max({values.size(), removed.size(), added.size()});
  for (std::vector<Value>* list : {&values, &removed, &added}) {
    list->resize(count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = sum(difference(values[i], removed[i]), added[i]);
  }
  return values;
}

/// The scene with the materials that a request changes.
std::shared_ptr<const Scene> scene_of(const LiveLightRequest& request) {
  const auto& scene = request.loaded->scene;
  const auto& materials = request.materials;
  return materials && std::ssize(materials->of_patch) == scene->patch_count()
             ? std::make_shared<const Scene>(*scene, materials->materials, materials->of_patch)
             : scene;
}

/// Whether the request differs from its solve by the sun alone.
bool moves_sun_only(const LiveLightRequest& request) {
  if (!request.solved) {
    return false;
  }
  const SolveOptions& solved = request.solved->options;
  Sky sky = solved.sky;
  sky.sun = request.options.sky.sun;
  return sky == request.options.sky &&
         (solved.glossy == request.options.glossy || !has_lobes(*request.loaded->scene));
}

/// The light of the sun requested, in place of the one of the solve.
/// @throws InputError, SolveError where form factors do not give it
Solution light_by_form_factors(const LiveLightRequest& request, const Cancellation& cancellation) {
  const SolverSnapshot& solved = *request.solved;
  const LoadedScene& loaded = *request.loaded;
  const auto light_of = [&](const Sky& sky) {
    SolveOptions options = solved.options;
    options.sky = sky;
    return sun_light(loaded.scene, loaded.tree, options, cancellation);
  };
  if (!request.sun_of_solve->has_value()) {
    *request.sun_of_solve = light_of(solved.options.sky);
  }
  const SunLight& before = **request.sun_of_solve;
  const SunLight now = light_of(request.options.sky);
  Solution light = solution_of(solved, true);
  light.scene = scene_of(request);
  light.sky = request.options.sky;
  light.sky_irradiance =
      exchanged(std::move(light.sky_irradiance), before.irradiance, now.irradiance);
  for (Rgb& value : light.sky_irradiance) {  // rounding
    value = {std::max(value.r, 0.0), std::max(value.g, 0.0), std::max(value.b, 0.0)};
  }
  light.sky_linear_terms =
      exchanged(std::move(light.sky_linear_terms), before.linear_terms, now.linear_terms);
  RelightOptions options = relight_options(solved);
  options.sky_irradiance = light.sky_irradiance;
  options.sky_linear_terms = light.sky_linear_terms;
  std::vector<std::int32_t> of_patch;
  for (const Patch& patch : light.scene->patches()) {
    of_patch.push_back(patch.material);
  }
  options.patch_materials = of_patch;
  RelightResult result =
      relight(*loaded.scene, *solved.form_factors, light.scene->materials(), options, cancellation);
  light.radiosity = std::move(result.radiosity);
  light.irradiance = std::move(result.irradiance);
  light.linear_terms = std::move(result.linear_terms);
  return light;
}

}  // namespace

LiveScene live_scene(const LiveRequest& request, const Cancellation& cancellation) {
  LiveScene live;
  auto description = request.base;
  if (!(request.placement == FacePlacement{})) {
    auto placed = std::make_shared<SceneDescription>(*request.base);
    place_faces(*placed, request.faces, request.pivot, request.placement);
    description = std::move(placed);
  }
  const auto loaded =
      edited_scene(*request.before, std::move(description), request.divided, cancellation);
  if (request.edit) {
    complete(*loaded, cancellation);
  }
  live.loaded = loaded;
  live.bases = std::make_shared<const std::vector<LinearBasis>>(linear_bases(*loaded->scene));
  if (request.map) {
    QElapsedTimer timer;
    timer.start();
    MapRequest wanted = *request.map;
    wanted.loaded = loaded;
    live.map = std::make_shared<const RecordedMap>(record_map(wanted, cancellation));
    live.seconds_map = 1e-9 * static_cast<double>(timer.nsecsElapsed());
  }
  return live;
}

Solution live_light(const LiveLightRequest& request, const Cancellation& cancellation) {
  if (moves_sun_only(request)) {
    try {
      return smoothed(light_by_form_factors(request, cancellation));
    } catch (const InputError&) {  // a first shot may not be stored by source
    } catch (const SolveError&) {
    }
  }
  LoadedScene loaded = *request.loaded;
  loaded.scene = scene_of(request);
  SolveOptions options = request.options;
  if (!takes_directions(options.engine)) {
    options.engine = SolveOptions{}.engine;
  }
  SolveSession draft = prepare_draft(options, loaded, nullptr, cancellation);
  draft.advance(SolveSession::Until::finished);
  return smoothed(draft.solution());
}

std::shared_ptr<const SolverSnapshot> live_snapshot(
    const SolverSnapshot& solved, const LiveScene& scene, const Solution* light,
    const std::shared_ptr<const PatchMaterials>& materials) {
  auto live = std::make_shared<SolverSnapshot>(solved);
  const Scene& before = *solved.loaded->scene;
  const Scene& after = *scene.loaded->scene;
  live->loaded = scene.loaded;
  live->glossy = nullptr;
  live->form_factors = nullptr;
  live->fitted = nullptr;
  if (!live->linear_terms.empty() || light != nullptr) {
    live->bases = scene.bases;
  }
  const bool same_patches =
      std::ranges::equal(before.patches(), after.patches(), {}, &Patch::face, &Patch::face);
  live->materials = same_patches ? materials : nullptr;
  if (light != nullptr) {
    show_light_of(*light, *live);
  } else if (!same_patches) {
    live->radiosity = by_face(solved.radiosity, before, after);
    live->irradiance = by_face(solved.irradiance, before, after);
    live->linear_terms.clear();
  }
  return live;
}

}  // namespace transillum::viewer
