// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/results/options_json.h"

namespace transillum {
namespace {

using Json = nlohmann::ordered_json;

/// The sky; null without one.
Json sky_json(const Sky& sky) {
  if (!sky.set()) {
    return {};
  }
  return {{"exitance", {sky.exitance.r, sky.exitance.g, sky.exitance.b}},
          {"model", name_of(sky.model)},
          {"up", {sky.up.x, sky.up.y, sky.up.z}}};
}

}  // namespace

Json options_json(const SolveOptions& options, const SceneOptions& scene_options) {
  Json json;
  json["directions"] = options.directions;
  json["sampling"] = name_of(options.used_sampling());
  json["seed"] = options.seed;
  json["rotation"] = options.rotation ? Json(*options.rotation) : Json();
  json["engine"] = name_of(options.engine);
  const int resolution = options.engine_options.resolution;
  json["resolution"] = resolution > 0 ? Json(resolution) : Json();
  const int points = options.engine_options.points;
  json["points"] = points > 0 ? Json(points) : Json();
  json["two_way"] = options.two_way;
  json["normalize"] = name_of(options.normalize);
  json["scheme"] = name_of(options.scheme);
  json["basis"] = name_of(options.basis);
  json["glossy"] = options.glossy;
  const bool averages = options.scheme == Scheme::semi_iterative;
  json["burn_in"] = averages && options.burn_in ? Json(*options.burn_in) : Json();
  json["replicas"] = options.replicas;
  json["first_shot"] = options.first_shot == first_shot_where_it_pays ? Json("auto")
                       : options.first_shot                           ? Json(*options.first_shot)
                                                                      : Json();
  // The stopping rule is one of them; the others are null.
  const bool by_number = options.iterations > 0;
  const bool by_mean = averages && !by_number && options.averaged_iterations > 0;
  json["iterations"] = by_number ? Json(options.iterations) : Json();
  json["averaged_iterations"] = by_mean ? Json(options.averaged_iterations) : Json();
  json["tolerance"] = by_number || by_mean ? Json() : Json(options.tolerance);
  json["sky"] = sky_json(options.sky);
  json["memory"] = options.memory > 0 ? Json(options.memory) : Json();
  json["threads"] = options.threads > 0 ? Json(options.threads) : Json();
  json["two_sided"] = scene_options.two_sided;
  json["max_patch_area"] =
      scene_options.max_patch_area > 0 ? Json(scene_options.max_patch_area) : Json();
  return json;
}

}  // namespace transillum
