// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/runs/run_identity.h"

#include <fmt/format.h>

#include "io/content_hash.h"
#include "io/results/result_writers.h"
#include "options/option_table.h"

namespace transillum {
namespace {

using Json = nlohmann::ordered_json;

Json scene_of(const Scene& scene, ContentHash::Method method) {
  ContentHash shape(method), light(method);
  shape.add_shape(scene);
  light.add_light(scene);
  return {{"name", scene.name()},
          {"patches", scene.patch_count()},
          {"shape", shape.digits()},
          {"light", light.digits()}};
}

/// A value of an option, shortened where it is long.
std::string text_of(const Json& value) {
  constexpr std::size_t longest = 60;
  if (value.is_null()) {
    return "not given";
  }
  const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() <= longest ? text : text.substr(0, longest) + "…";
}

}  // namespace

Json run_options(const SolveOptions& options, const SceneOptions& scene_options) {
  Json json = options_json({.solve = options, .scene = scene_options});
  for (const Option& option : transillum::options()) {
    if (option.of_machine) {
      json.erase(option.name);
    }
  }
  json.erase("glossy");  // glossy solves have no checkpoints and no shards
  const EngineOptions& engine = options.engine_options;
  json["lines"] = engine.lines_per_patch;
  json["random-lines"] = !engine.gridded;
  return json;
}

RunIdentity run_identity(const Scene& scene, const SolveOptions& options) {
  return {{{"version", TRANSILLUM_VERSION},
           {"scene", scene_of(scene, ContentHash::Method::xxh3)},
           {"options", run_options(options, scene.options())}},
          scene_of(scene, ContentHash::Method::md5)};
}

void check_identity(const SealedFile& file, const RunIdentity& identity) {
  const Json& expected = identity.json;
  const Json found = file.head().value("run", Json());
  const auto part = [&](const char* name) {
    return found.is_object() ? found.value(name, Json()) : Json();
  };
  if (part("version") != expected["version"]) {
    file.refuse(fmt::format("it was written by transillum {}, this is {}", text_of(part("version")),
                            text_of(expected["version"])));
  }
  const auto compare = [&](const char* name) {
    const Json options = part(name);
    if (!options.is_object()) {
      file.refuse("its head is damaged");
    }
    for (const auto& [key, value] : expected[name].items()) {
      const Json other = options.value(key, Json());
      if (other != value) {
        file.refuse(fmt::format("it is of a {} with other options: {} is {} there and {} here",
                                name == std::string("study") ? "study" : "solve", key,
                                text_of(other), text_of(value)));
      }
    }
  };
  compare("options");
  if (expected.contains("study")) {
    compare("study");
  }
  const Json scene = part("scene");
  if (!scene.is_object()) {
    file.refuse("its head is damaged");
  }
  const Json shape = scene.value("shape", Json());
  const bool former = shape.is_string() &&
                      ContentHash::method_of(shape.get<std::string>()) == ContentHash::Method::md5;
  const Json& wanted = former ? identity.former_scene : expected["scene"];
  const auto differs = [&](const char* name) { return scene.value(name, Json()) != wanted[name]; };
  if (differs("patches")) {
    file.refuse(fmt::format("it is of another scene: {} has {} patches, this one has {}",
                            text_of(scene.value("name", Json())),
                            text_of(scene.value("patches", Json())), text_of(wanted["patches"])));
  }
  if (differs("shape") || differs("light")) {
    file.refuse(fmt::format("it is of another scene: its {} differ from those here",
                            differs("shape") ? "polygons" : "reflectances or exitances"));
  }
}

}  // namespace transillum
