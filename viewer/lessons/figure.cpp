// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Figures in lesson files: {"figure": "form-factor", "patch": 16, "others": [9]}. One table says
// which keys each figure has.
#include "lessons/figure.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lessons/view_state.h"
#include "model/run_options.h"
#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr int largest_number = 1 << 30;
constexpr int most_reference_passes = 1 << 16;

// Which keys a figure has besides "figure" and "with".
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

struct FigureName {
  const char* name;
  FigureKind kind;
  unsigned keys;
};
constexpr FigureName names[] = {
    {"patches", FigureKind::patches, none},
    {"fragments", FigureKind::fragments, none},
    {"directions", FigureKind::directions, has_run},
    {"iterations", FigureKind::iterations, has_run},
    {"contraction", FigureKind::contraction, has_run},
    {"steps", FigureKind::steps, has_direction | has_run},
    {"polygons", FigureKind::polygons, has_direction | has_run},
    {"area", FigureKind::area, has_patch},
    {"exitance", FigureKind::exitance, has_patch},
    {"reflectance", FigureKind::reflectance, has_patch},
    {"radiosity", FigureKind::radiosity, has_patch | has_run},
    {"irradiance", FigureKind::irradiance, has_patch | has_run},
    {"radiance", FigureKind::radiance, has_patch | has_run | has_eye},
    {"jump", FigureKind::jump, has_patch | has_run},
    {"projected-area", FigureKind::projected_area, has_patch | has_direction | has_run},
    {"visible-area", FigureKind::visible_area, has_patch | has_others | has_direction | has_run},
    {"seen", FigureKind::seen, has_patch | has_direction | has_run},
    {"above", FigureKind::above, has_others | has_material | has_direction | has_run},
    {"form-factor", FigureKind::form_factor, has_patch | has_others | has_run},
    {"form-factor-sum", FigureKind::form_factor_sum, has_patch | has_run},
    {"function-error", FigureKind::function_error, has_run | has_areas},
    {"rms-error", FigureKind::rms_error, has_run | has_reference},
    {"estimated-error", FigureKind::estimated_error, has_run},
    {"largest-error", FigureKind::largest_error, has_run},
    {"light-directions", FigureKind::light_directions, has_run},
    {"covered", FigureKind::covered, has_run | has_reference},
    {"ratio", FigureKind::ratio, has_parts}};

unsigned keys_of(FigureKind kind) {
  const auto* found = std::find_if(std::begin(names), std::end(names),
                                   [kind](const FigureName& known) { return known.kind == kind; });
  return found == std::end(names) ? none : found->keys;
}

FigureName name_from(JsonObject& object) {
  std::string name, choices;
  object.read("figure", name);
  for (const FigureName& known : names) {
    if (name == known.name) {
      return known;
    }
    choices += (choices.empty() ? "" : ", ") + std::string(known.name);
  }
  object.fail_at(
      "figure", name.empty() ? "is missing"
                             : "unknown figure " + in_quotes(name) + "; known figures: " + choices);
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
                                item.get<double>() <= largest_number;
                       });
  if (!numbers) {
    object.fail_at(key, "must be a list of patches [0, …] or, except for \"above\", \"all\"");
  }
  return list->get<std::vector<PatchId>>();
}

void read_direction(Figure& figure, JsonObject& object, const ViewState& page) {
  int direction = page.focus ? page.focus->direction + 1 : 0;
  object.read("direction", direction, 1, largest_number);
  if (direction == 0) {
    object.fail_at("direction", "is missing, and the page has no focus");
  }
  figure.direction = direction - 1;
  figure.iteration = page.focus ? page.focus->iteration : 0;
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

Figure figure_from_json(const json& value, const std::string& where, const json& page_options,
                        const ViewState& page) {
  Figure figure;
  if (value.is_number()) {
    figure.number = value.get<double>();
    return figure;
  }
  JsonObject object(value, where);
  const FigureName name = name_from(object);
  figure.kind = name.kind;
  figure.solve = page.options.solve;
  if (name.keys & has_patch) {
    object.read("patch", figure.patch, 0, largest_number);
  }
  if (name.keys & has_others) {
    const json* others = object.find("others");
    figure.all = others && *others == "all" && name.kind != FigureKind::above;
    if (!figure.all) {
      figure.others = patches_from(object, "others");
    }
  }
  if (name.keys & has_material) {
    object.read("material", figure.material);
  }
  if (name.keys & has_run) {
    figure.solve = run_from_json(object, page_options, page);
  }
  if (name.keys & has_direction) {
    read_direction(figure, object, page);
  }
  if (name.keys & has_eye) {
    if (!object.find("eye") && !page.camera) {
      object.fail_at("eye", "is missing, and the page has no camera");
    }
    figure.eye = page.camera ? page.camera->eye : Vec3{};
    object.read("eye", figure.eye);
    figure.changes = material_changes_from_json(object, "materials");
  }
  if (name.keys & has_reference) {
    figure.reference = 8 * page.options.solve.directions;
    object.read("reference", figure.reference, 1, most_reference_passes);
    bool without_sources = true;  // older lessons have this key: errors are always measured without
                                  // sources
    object.read("without-sources", without_sources);
  }
  if (name.keys & has_areas) {
    figure.patch_area = page.options.scene.max_patch_area;
    object.read("patch-area", figure.patch_area);
    object.read("reference-area", figure.reference_area);
    if (!(figure.patch_area >= 0 && figure.reference_area > 0)) {
      object.fail_at("reference-area", "and \"patch-area\" must be areas in m²");
    }
  }
  if (name.keys & has_parts) {
    const json* parts = object.find("of");
    if (!parts || !parts->is_array() || parts->size() != 2) {
      object.fail_at("of", "must be a list of two figures");
    }
    for (const json& part : *parts) {
      figure.parts.push_back(figure_from_json(part, object.where("of"), page_options, page));
      if (is_per_patch(figure.parts.back())) {
        object.fail_at("of", "each figure must be one number: a patch is missing");
      }
    }
  }
  object.done();
  return figure;
}

bool is_of_direction(FigureKind kind) { return (keys_of(kind) & has_direction) != 0; }

bool is_per_patch(const Figure& figure) {
  const unsigned keys = keys_of(figure.kind);
  return ((keys & has_patch) && figure.patch == no_patch) ||
         ((keys & has_others) && figure.others.empty() && !figure.all);
}

bool is_computed(const Figure& figure) { return figure.kind != FigureKind::constant; }

std::vector<std::string> figure_names() {
  std::vector<std::string> all;
  for (const FigureName& known : names) {
    all.emplace_back(known.name);
  }
  return all;
}

}  // namespace transillum::viewer
