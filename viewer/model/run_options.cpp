// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/run_options.h"

#include <cmath>

#include "model/material_json.h"
#include "support/json_object.h"
#include "transillum/first_shot.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

void read_seed(JsonObject& object, const char* key, std::uint64_t& value) {
  const json* found = object.find(key);
  if (!found) {
    return;
  }
  if (!found->is_number_unsigned()) {
    object.fail_at(key, "must be a whole number, 0 or more");
  }
  value = found->get<std::uint64_t>();
}

template <class Value, class FromName>
void read_named(JsonObject& object, const char* key, Value& value, FromName from_name) {
  std::string name;
  object.read(key, name);
  if (name.empty()) {
    return;
  }
  try {
    value = from_name(name);
  } catch (const InputError& error) {
    object.fail_at(key, error.what());
  }
}

void read_sky(JsonObject& object, Sky& sky) {
  if (const json* exitance = object.find("sky")) {
    const Vec3 value =
        exitance->is_number()
            ? Vec3{exitance->get<double>(), exitance->get<double>(), exitance->get<double>()}
            : vec3_from_json(*exitance, object.where("sky"));
    sky.exitance = {value.x, value.y, value.z};
  }
  read_named(object, "sky-model", sky.model, sky_model_from_name);
  Vec3 up = sky.up;
  object.read("up", up);
  const double length = norm(up);
  if (!(length > 0) || !std::isfinite(length)) {
    object.fail_at("up", "must be a direction, not all 0");
  }
  // A unit vector keeps its bits.
  sky.up = std::abs(length - 1) < 1e-12 ? up : normalized(up);
}

void read_refinement(JsonObject& object, const SolveOptions& solve, RefineChoice& refine) {
  std::string by = "none";
  object.read("refine-by", by);
  object.read("patches", refine.patches, 0, 1 << 26);
  object.read("refine-until", refine.until);
  if (by == "none") {
    return;
  }
  try {
    refine.by = refine_by_from_name(by);
    refine.options().validate();
  } catch (const InputError& error) {
    object.fail_at("refine-by", error.what());
  }
  if (solve.goal.seconds > 0) {
    object.fail_at("refine-by", "not together with \"seconds\"");
  }
}

SceneInput input_from(const json& value, const std::string& where) {
  SceneInput input;
  JsonObject object(value, where);
  object.read("default-reflectance", input.read.default_reflectance);
  if (object.find("max-reflectance")) {
    object.read("max-reflectance", input.read.max_reflectance.emplace());
  }
  object.read("scale", input.read.scale);
  if (object.find("join")) {
    object.read("join", input.read.join.emplace());
  }
  object.read("photometric", input.read.photometric);
  object.read("turn-faces", input.orient);
  input.changes = material_changes_from_json(object, "changes");
  object.done();
  try {
    input.read.validate();
  } catch (const InputError& error) {
    object.fail(error.what());
  }
  return input;
}

json to_json(const SceneInput& input) {
  const ReadOptions& read = input.read;
  return {{"default-reflectance", read.default_reflectance},
          {"max-reflectance", read.max_reflectance ? json(*read.max_reflectance) : json()},
          {"scale", read.scale},
          {"join", read.join ? json(*read.join) : json()},
          {"photometric", read.photometric},
          {"turn-faces", input.orient},
          {"changes", viewer::to_json(input.changes)}};
}

}  // namespace

std::optional<Sampling> unless_default(Sampling sampling, bool two_way) {
  return sampling == default_sampling(two_way) ? std::nullopt : std::optional(sampling);
}

RunOptions run_options_from_json(const json& value, const std::string& where) {
  RunOptions options;
  SolveOptions& solve = options.solve;
  JsonObject object(value, where);
  object.read("directions", solve.directions, 1, 1 << 24);
  const bool has_sampling = object.find("sampling");
  Sampling sampling = default_sampling(true);
  read_named(object, "sampling", sampling, sampling_from_name);
  read_seed(object, "seed", solve.seed);
  if (object.find("rotate")) {
    read_seed(object, "rotate", solve.rotation.emplace());
  }
  read_named(object, "engine", solve.engine, engine_from_name);
  object.read("resolution", solve.engine_options.resolution, 0, EngineOptions::largest_resolution);
  object.read("two-way", solve.two_way);
  if (has_sampling) {
    solve.sampling = unless_default(sampling, solve.two_way);
  }
  read_named(object, "normalize", solve.normalize, normalization_from_name);
  read_named(object, "scheme", solve.scheme, scheme_from_name);
  read_named(object, "basis", solve.basis, basis_from_name);
  object.read("glossy", solve.glossy);
  read_named(object, "first-shot", solve.first_shot, first_shot_from_name);
  if (object.find("burn-in")) {
    object.read("burn-in", solve.burn_in.emplace(), 0, 1'000'000);
  }
  object.read("replicas", solve.replicas, 1, 64);
  object.read("accuracy", solve.goal.accuracy);
  AccuracyGoal of;
  read_named(object, "accuracy-of", of, accuracy_of_from_name);
  solve.goal.of = of.of;
  solve.goal.patch = of.patch;
  object.read("seconds", solve.goal.seconds);
  object.read("iterations", solve.iterations, 0, 1'000'000);
  object.read("tolerance", solve.tolerance);
  read_sky(object, solve.sky);
  object.read("two-sided", options.scene.two_sided);
  object.read("max-patch-area", options.scene.max_patch_area);
  if (!(options.scene.max_patch_area >= 0)) {
    object.fail_at("max-patch-area", "must be an area in m², or 0 for no limit");
  }
  read_refinement(object, solve, options.refine);
  if (const json* input = object.find("read")) {
    options.input = input_from(*input, object.where("read"));
  }
  object.done();
  try {
    solve.validate();
  } catch (const InputError& error) {
    object.fail(error.what());
  }
  return options;
}

json to_json(const RunOptions& options) {
  const SolveOptions& solve = options.solve;
  json result = {{"directions", solve.directions},
                 {"sampling", name_of(solve.used_sampling())},
                 {"seed", solve.seed},
                 {"rotate", solve.rotation ? json(*solve.rotation) : json()},
                 {"engine", name_of(solve.engine)},
                 {"resolution", solve.engine_options.resolution},
                 {"two-way", solve.two_way},
                 {"normalize", name_of(solve.normalize)},
                 {"scheme", name_of(solve.scheme)},
                 {"basis", name_of(solve.basis)},
                 {"glossy", solve.glossy},
                 {"first-shot", name_of_first_shot(solve.first_shot)},
                 {"burn-in", solve.burn_in ? json(*solve.burn_in) : json()},
                 {"replicas", solve.replicas},
                 {"accuracy", solve.goal.accuracy},
                 {"accuracy-of", name_of_accuracy(solve.goal)},
                 {"seconds", solve.goal.seconds},
                 {"iterations", solve.iterations},
                 {"tolerance", solve.tolerance},
                 {"sky", {solve.sky.exitance.r, solve.sky.exitance.g, solve.sky.exitance.b}},
                 {"sky-model", name_of(solve.sky.model)},
                 {"up", to_json(solve.sky.up)},
                 {"two-sided", options.scene.two_sided},
                 {"max-patch-area", options.scene.max_patch_area},
                 {"refine-by", options.refine.set() ? name_of(*options.refine.by) : "none"},
                 {"patches", options.refine.patches},
                 {"refine-until", options.refine.until}};
  if (!(options.input == SceneInput{})) {
    result["read"] = to_json(options.input);
  }
  return result;
}

}  // namespace transillum::viewer
