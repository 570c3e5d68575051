// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/run_options.h"

#include <set>

#include "model/material_json.h"
#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr const char* material_changes = "changes";

/// Whether files store the option: it describes the run, not the computer that wrote the file.
bool is_stored(const Option& option) { return option.in_files && option.group != "Machine"; }

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
  }
  return expected == in_effect;
}

RunOptions run_options_from_json(const json& value, const std::string& where) {
  RunOptions options;
  JsonObject object(value, where);
  const std::set<std::string> given = read_options(object, value, options);
  if (const json* read = object.find("read")) {
    JsonObject input(*read, object.where("read"));
    read_options(input, *read, options);
    options.input.changes = material_changes_from_json(input, material_changes);
    input.done();
  }
  object.done();
  try {
    set_dependent_defaults(options, given);
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

}  // namespace transillum::viewer
