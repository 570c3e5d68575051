// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/run_options.h"

#include <cmath>
#include <optional>
#include <set>

#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr const char* material_changes = "changes";

/// Whether files store the option: it describes the run, not the computer that wrote the file.
bool is_stored(const Option& option) { return option.in_files && option.section != "Machine"; }

/// Sets the options that an object has; returns their names.
std::set<std::string> read_options(JsonObject& object, const json& value, RunOptions& options) {
  std::set<std::string> given;
  for (const auto& [key, text] : value.items()) {
    try {
      if (set_from_json(options, key, text.dump(-1, ' ', false, json::error_handler_t::replace))) {
        object.find(key);
        given.insert(key);
      }
    } catch (const InputError& error) {
      object.fail_at(key, error.what());
    }
  }
  return given;
}

json options_json(const RunOptions& options, bool of_reading) {
  json result = json::object();
  for (const Option& option : transillum::options()) {
    if (is_stored(option) && option.reads_scene == of_reading) {
      result[option.name] = json::parse(option.to_json(options));
    }
  }
  return result;
}

}  // namespace

bool is_run_of(const SolveOptions& in_effect, const SolveOptions& asked) {
  SolveOptions expected = asked;
  if (expected.goal.is_set() && expected.goal == in_effect.goal) {
    expected.directions = in_effect.directions;
    expected.replicas = in_effect.replicas;
    expected.tolerance = in_effect.tolerance;
    expected.engine_options.points = in_effect.engine_options.points;
  }
  return expected == in_effect;
}

RunOptions run_options_from_json(const json& value, const std::string& where) {
  RunOptions options;
  // An option that a file lacks is as it was before there was one.
  options.solve.first_shot.reset();
  JsonObject object(value, where);
  std::set<std::string> given = read_options(object, value, options);
  given.insert("accuracy");
  if (const json* read = object.find("read")) {
    JsonObject input(*read, object.where("read"));
    read_options(input, *read, options);
    options.input.changes = material_changes_from_json(input, material_changes);
    input.done();
  }
  object.done();
  try {
    set_dependent_defaults(options, given);
    Sun& sun = options.solve.sky.sun;  // files have no irradiance of a sun below the horizon
    sun.below_horizon = !sun.is_set() && !(sun.direction == Vec3{});
    options.input.patches = 0;  // only the command line has this option; files have the area
    options.validate();
  } catch (const InputError& error) {
    object.fail(error.what());
  }
  return options;
}

json to_json(const RunOptions& options) {
  json result = options_json(options, false);
  if (!(options.input == SceneInput{})) {
    result["read"] = options_json(options, true);
    result["read"][material_changes] = to_json(options.input.changes);
  }
  return result;
}

using nlohmann::json;

namespace {

std::optional<Rgb> channels_from(JsonObject& object, const char* key, bool below_one) {
  const json* channels = object.find(key);
  if (!channels) {
    return std::nullopt;
  }
  const Vec3 c = vec3_from_json(*channels, object.where(key));
  for (const double x : {c.x, c.y, c.z}) {
    if (!(x >= 0 && std::isfinite(x) && (!below_one || x < 1))) {
      object.fail_at(key, below_one ? "must be at least 0 and below 1" : "must be at least 0");
    }
  }
  return Rgb{c.x, c.y, c.z};
}

Lobe lobe_from(const json& value, const std::string& where) {
  JsonObject object(value, where);
  Lobe lobe;
  const std::optional<Rgb> fraction = channels_from(object, "share", true);
  if (!fraction) {
    object.fail_at("share", "is missing");
  }
  lobe.reflectance = *fraction;
  const bool is_rough = object.find("roughness");
  object.read("exponent", lobe.exponent);
  if (is_rough) {
    object.read("roughness", lobe.roughness);
    lobe.shape = LobeShape::ggx;
  }
  if (!(lobe.exponent >= 0 && std::isfinite(lobe.exponent))) {
    object.fail_at("exponent", "must be at least 0");
  }
  if (!(lobe.roughness >= 0 && lobe.roughness <= 1)) {
    object.fail_at("roughness", "must be between 0 and 1");
  }
  object.done();
  return lobe;
}

MaterialChange change_from(const json& value, const std::string& where) {
  JsonObject object(value, where);
  MaterialChange change;
  object.read("name", change.target);
  if (change.target.empty()) {
    object.fail_at("name", "is missing");
  }
  change.exitance = channels_from(object, "exitance", false);
  change.reflectance = channels_from(object, "reflectance", true);
  if (const json* lobe = object.find("lobe")) {
    change.lobe = lobe_from(*lobe, object.where("lobe"));
  }
  if (!change.exitance && !change.reflectance && !change.lobe) {
    object.fail("needs an \"exitance\", a \"reflectance\" or a \"lobe\"");
  }
  object.done();
  return change;
}

}  // namespace

std::vector<MaterialChange> material_changes_from_json(JsonObject& object, const char* key) {
  std::vector<MaterialChange> changes;
  const json* list = object.find(key);
  if (!list) {
    return changes;
  }
  if (!list->is_array()) {
    object.fail_at(key, "must be a list [ … ]");
  }
  for (const json& one : *list) {
    changes.push_back(
        change_from(one, object.where("material " + std::to_string(changes.size() + 1))));
  }
  return changes;
}

json to_json(const std::vector<MaterialChange>& changes) {
  const auto list = [](const Rgb& c) { return json::array({c.r, c.g, c.b}); };
  json result = json::array();
  for (const MaterialChange& change : changes) {
    json one = {{"name", change.target}};
    if (change.exitance) {
      one["exitance"] = list(*change.exitance);
    }
    if (change.reflectance) {
      one["reflectance"] = list(*change.reflectance);
    }
    if (change.lobe) {
      json lobe = {{"share", list(change.lobe->reflectance)}};
      if (change.lobe->shape == LobeShape::ggx) {
        lobe["roughness"] = change.lobe->roughness;
      } else {
        lobe["exponent"] = change.lobe->exponent;
      }
      one["lobe"] = std::move(lobe);
    }
    result.push_back(std::move(one));
  }
  return result;
}

}  // namespace transillum::viewer
