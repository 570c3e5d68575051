// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Values in lesson files: {"figure": "form-factor", "patch": 16, "others": [9]}. One table says
// which keys each value has.
#include "lessons/lesson_value.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lessons/view_state.h"
#include "model/run_options.h"
#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr int largest_value = 1 << 30;
constexpr int most_reference_passes = 1 << 16;

// Which keys a value has besides "figure" and "with".
enum Keys : unsigned {
  none = 0,
  has_patch = 1,
  has_others = 2,
  has_direction = 4,
  has_run = 8,
  has_reference = 16,
  has_material = 32,
  has_parts = 64,
  has_areas = 128,
  has_eye = 256
};

struct ValueName {
  const char* name;
  LessonValueKind kind;
  unsigned keys;
};
constexpr ValueName names[] = {
    {"patches", LessonValueKind::patches, none},
    {"fragments", LessonValueKind::fragments, none},
    {"directions", LessonValueKind::directions, has_run},
    {"iterations", LessonValueKind::iterations, has_run},
    {"contraction", LessonValueKind::contraction, has_run},
    {"steps", LessonValueKind::steps, has_direction | has_run},
    {"polygons", LessonValueKind::polygons, has_direction | has_run},
    {"area", LessonValueKind::area, has_patch},
    {"exitance", LessonValueKind::exitance, has_patch},
    {"reflectance", LessonValueKind::reflectance, has_patch},
    {"radiosity", LessonValueKind::radiosity, has_patch | has_run},
    {"irradiance", LessonValueKind::irradiance, has_patch | has_run},
    {"radiance", LessonValueKind::radiance, has_patch | has_run | has_eye},
    {"jump", LessonValueKind::jump, has_patch | has_run},
    {"projected-area", LessonValueKind::projected_area, has_patch | has_direction | has_run},
    {"visible-area", LessonValueKind::visible_area,
     has_patch | has_others | has_direction | has_run},
    {"seen", LessonValueKind::seen, has_patch | has_direction | has_run},
    {"above", LessonValueKind::above, has_others | has_material | has_direction | has_run},
    {"form-factor", LessonValueKind::form_factor, has_patch | has_others | has_run},
    {"form-factor-sum", LessonValueKind::form_factor_sum, has_patch | has_run},
    {"function-error", LessonValueKind::function_error, has_run | has_areas},
    {"rms-error", LessonValueKind::rms_error, has_run | has_reference},
    {"estimated-error", LessonValueKind::estimated_error, has_run},
    {"largest-error", LessonValueKind::largest_error, has_run},
    {"light-directions", LessonValueKind::light_directions, has_run},
    {"covered", LessonValueKind::covered, has_run | has_reference},
    {"ratio", LessonValueKind::ratio, has_parts}};

unsigned keys_of(LessonValueKind kind) {
  const auto* found = std::find_if(std::begin(names), std::end(names),
                                   [kind](const ValueName& known) { return known.kind == kind; });
  return found == std::end(names) ? none : found->keys;
}

ValueName name_from(JsonObject& object) {
  std::string name, choices;
  object.read("figure", name);
  for (const ValueName& known : names) {
    if (name == known.name) {
      return known;
    }
    choices += (choices.empty() ? "" : ", ") + std::string(known.name);
  }
  object.fail_at("figure", name.empty()
                               ? "is missing"
                               : "unknown value " + in_quotes(name) + "; known values: " + choices);
}

std::vector<PatchId> patches_from(JsonObject& object, const char* key) {
  std::vector<PatchId> patches;
  const json* list = object.find(key);
  if (!list) {
    return patches;
  }
  const bool numbers = list->is_array() && !list->empty() &&
                       std::all_of(list->begin(), list->end(), [](const json& item) {
                         return item.is_number_integer() && item.get<double>() >= 0 &&
                                item.get<double>() <= largest_value;
                       });
  if (!numbers) {
    object.fail_at(key, "must be a list of patches [0, …] or, except for \"above\", \"all\"");
  }
  return list->get<std::vector<PatchId>>();
}

void read_direction(LessonValue& wanted, JsonObject& object, const ViewState& page) {
  int direction = page.focus ? page.focus->direction + 1 : 0;
  object.read("direction", direction, 1, largest_value);
  if (direction == 0) {
    object.fail_at("direction", "is missing, and the page has no focus");
  }
  wanted.direction = direction - 1;
  wanted.iteration = page.focus ? page.focus->iteration : 0;
}

}  // namespace

SolveOptions run_from_json(JsonObject& object, const json& page_options, const ViewState& page) {
  const json* with = object.find("with");
  if (!with) {
    return page.options.solve;
  }
  if (!with->is_object()) {
    object.fail_at("with", "must be an object { … } of options");
  }
  json options = page_options.is_object() ? page_options : json::object();
  options.merge_patch(*with);
  const RunOptions run = run_options_from_json(options, object.where("with"));
  RunOptions same = page.options;
  same.solve = run.solve;
  if (!(same == run)) {
    object.fail_at("with", "can change options of the solve, not of the scene");
  }
  return run.solve;
}

LessonValue lesson_value_from_json(const json& value, const std::string& where,
                                   const json& page_options, const ViewState& page) {
  LessonValue wanted;
  if (value.is_number()) {
    wanted.number = value.get<double>();
    return wanted;
  }
  JsonObject object(value, where);
  const ValueName name = name_from(object);
  wanted.kind = name.kind;
  wanted.solve = page.options.solve;
  if (name.keys & has_patch) {
    object.read("patch", wanted.patch, 0, largest_value);
  }
  if (name.keys & has_others) {
    const json* others = object.find("others");
    wanted.all = others && *others == "all" && name.kind != LessonValueKind::above;
    if (!wanted.all) {
      wanted.others = patches_from(object, "others");
    }
  }
  if (name.keys & has_material) {
    object.read("material", wanted.material);
  }
  if (name.keys & has_run) {
    wanted.solve = run_from_json(object, page_options, page);
  }
  if (name.keys & has_direction) {
    read_direction(wanted, object, page);
  }
  if (name.keys & has_eye) {
    if (!object.find("eye") && !page.camera) {
      object.fail_at("eye", "is missing, and the page has no camera");
    }
    wanted.eye = page.camera ? page.camera->eye : Vec3{};
    object.read("eye", wanted.eye);
    wanted.changes = material_changes_from_json(object, "materials");
  }
  if (name.keys & has_reference) {
    wanted.reference = 8 * page.options.solve.directions;
    object.read("reference", wanted.reference, 1, most_reference_passes);
    bool without_sources = true;  // older lessons have this key: errors are always measured without
                                  // sources
    object.read("without-sources", without_sources);
  }
  if (name.keys & has_areas) {
    wanted.patch_area = page.options.scene.max_patch_area;
    object.read("patch-area", wanted.patch_area);
    object.read("reference-area", wanted.reference_area);
    if (!(wanted.patch_area >= 0 && wanted.reference_area > 0)) {
      object.fail_at("reference-area", "and \"patch-area\" must be areas in m²");
    }
  }
  if (name.keys & has_parts) {
    const json* parts = object.find("of");
    if (!parts || !parts->is_array() || parts->size() != 2) {
      object.fail_at("of", "must be a list of two values");
    }
    for (const json& part : *parts) {
      wanted.of.push_back(lesson_value_from_json(part, object.where("of"), page_options, page));
      if (is_per_patch(wanted.of.back())) {
        object.fail_at("of", "each value must be one number: a patch is missing");
      }
    }
  }
  object.done();
  return wanted;
}

bool is_of_direction(LessonValueKind kind) { return (keys_of(kind) & has_direction) != 0; }

bool is_per_patch(const LessonValue& wanted) {
  const unsigned keys = keys_of(wanted.kind);
  return ((keys & has_patch) && wanted.patch == no_patch) ||
         ((keys & has_others) && wanted.others.empty() && !wanted.all);
}

bool is_computed(const LessonValue& wanted) { return wanted.kind != LessonValueKind::constant; }

std::vector<std::string> lesson_value_names() {
  std::vector<std::string> all;
  for (const ValueName& known : names) {
    all.emplace_back(known.name);
  }
  return all;
}

}  // namespace transillum::viewer
