// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Controls in the text of a lesson's page: {"M": {"option": "directions", "values": [16, 64]}}.
#include "lessons/page_control.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr std::size_t most_values = 64, most_controls = 16;

void read_values(PageControl& control, JsonObject& object, const json& page_options) {
  const json* list = object.find("values");
  if (!list || !list->is_array() || list->size() < 2 || list->size() > most_values) {
    object.fail_at("values", "must be a list of 2 to 64 values");
  }
  for (const json& value : *list) {
    json options = page_options.is_object() ? page_options : json::object();
    const SceneOptions before = run_options_from_json(options, object.where("values")).scene;
    options[control.target] = value;
    const RunOptions run = run_options_from_json(options, object.where("values"));
    if (run.scene.max_patch_area != before.max_patch_area ||
        run.scene.two_sided != before.two_sided || value.is_structured()) {
      object.fail_at("option", "must be an option of the solve, not of the scene");
    }
    control.values.push_back(value.dump());
    control.labels.push_back(value.is_string() ? value.get<std::string>() : value.dump());
  }
  control.slides =
      std::all_of(list->begin(), list->end(), [](const json& value) { return value.is_number(); });
  const json* labels = object.find("labels");
  if (!labels) {
    return;
  }
  const bool fits =
      labels->is_array() && labels->size() == control.values.size() &&
      std::all_of(labels->begin(), labels->end(), [](const json& one) { return one.is_string(); });
  if (!fits) {
    object.fail_at("labels", "must be a list of as many names as there are values");
  }
  control.labels = labels->get<std::vector<std::string>>();
}

void read_range(PageControl& control, JsonObject& object) {
  const bool of_light = control.kind == PageControl::Kind::exitance;
  control.high = of_light ? 100 : 0.95;
  object.read("from", control.low);
  object.read("to", control.high);
  const double most = of_light ? 1e6 : 0.99;
  if (!(control.low >= 0 && control.low < control.high && control.high <= most)) {
    object.fail_at("to", of_light ? "\"from\" and \"to\" must be a range within 0 to 1e6 W/m²"
                                  : "\"from\" and \"to\" must be a range within 0 to 0.99");
  }
}

PageControl control_from(const json& value, const std::string& where, const json& page_options) {
  PageControl control;
  JsonObject object(value, where);
  std::string focus;
  object.read("option", control.target);
  object.read("focus", focus);
  const auto read_target = [&](const char* key, PageControl::Kind kind) {
    if (object.find(key)) {
      object.read(key, control.target);
      control.kind = kind;
    }
  };
  read_target("reflectance", PageControl::Kind::reflectance);
  read_target("exitance", PageControl::Kind::exitance);
  if (!focus.empty()) {
    if (focus != "step" && focus != "direction") {
      object.fail_at("focus", "must be \"step\" or \"direction\"");
    }
    control.kind = focus == "step" ? PageControl::Kind::step : PageControl::Kind::direction;
  } else if (control.target.empty()) {
    object.fail("needs one of the keys \"option\", \"reflectance\", \"exitance\", \"focus\"");
  } else if (control.kind == PageControl::Kind::option) {
    read_values(control, object, page_options);
  } else {
    read_range(control, object);
  }
  object.done();
  return control;
}

}  // namespace

std::vector<PageControl> controls_from_json(const json& value, const std::string& where,
                                            const json& page_options, const std::string& text) {
  if (!value.is_object() || value.size() > most_controls) {
    throw InputError(where + ": must be an object { … } of at most 16 controls");
  }
  std::vector<PageControl> controls;
  for (const auto& [name, one] : value.items()) {
    const std::string place = where + ", " + name;
    PageControl& control = controls.emplace_back(control_from(one, place, page_options));
    control.name = name;
    const std::string mark = '{' + name + '}';
    const std::size_t first = text.find(mark);
    if (name.empty() || first == std::string::npos ||
        text.find(mark, first + 1) != std::string::npos) {
      throw InputError(place + ": " + in_quotes(mark) + " must be in the text once");
    }
  }
  return controls;
}

RunOptions with_option(const RunOptions& options, const std::string& name,
                       const std::string& value) {
  json all = to_json(options);
  all[name] = json::parse(value);
  RunOptions changed = run_options_from_json(all, name);
  changed.solve.threads = options.solve.threads;
  changed.solve.memory = options.solve.memory;
  return changed;
}

int value_in(const PageControl& control, const RunOptions& options) {
  const json all = to_json(options);
  const auto now = all.find(control.target);
  for (std::size_t k = 0; now != all.end() && k < control.values.size(); ++k) {
    if (json::parse(control.values[k]) == *now) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

}  // namespace transillum::viewer
