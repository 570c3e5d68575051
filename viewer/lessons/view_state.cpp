// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The state of the window to and from JSON.
#include "lessons/view_state.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "model/run_options.h"
#include "support/json_object.h"
#include "support/names.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr int largest_number = std::numeric_limits<int>::max() - 1;  ///< a step of this number is
                                                                     ///< the last one

constexpr Name<ColorMode> color_modes[] = {{"true-color", ColorMode::true_color},
                                           {"luminance", ColorMode::luminance},
                                           {"red", ColorMode::red},
                                           {"green", ColorMode::green},
                                           {"blue", ColorMode::blue}};
constexpr Name<Quantity> quantities[] = {{"radiosity", Quantity::radiosity},
                                         {"eye-radiance", Quantity::eye_radiance},
                                         {"exitance", Quantity::exitance},
                                         {"reflectance", Quantity::reflectance},
                                         {"irradiance", Quantity::irradiance},
                                         {"form-factor-from", Quantity::form_factor_from},
                                         {"form-factor-to", Quantity::form_factor_to},
                                         {"form-factor-sum", Quantity::form_factor_sum},
                                         {"sky-share", Quantity::sky_fraction},
                                         {"origin", Quantity::origin},
                                         {"response", Quantity::response},
                                         {"fragments", Quantity::fragments},
                                         {"query-time", Quantity::query_time},
                                         {"exact-queries", Quantity::exact_queries},
                                         {"error", Quantity::error},
                                         {"last-change", Quantity::last_change},
                                         {"jump", Quantity::jump}};
constexpr Name<ColorMap> color_maps[] = {
    {"viridis", ColorMap::viridis}, {"cividis", ColorMap::cividis}, {"inferno", ColorMap::inferno}};
constexpr Name<RangeRule> range_rules[] = {{"automatic", RangeRule::automatic},
                                           {"locked", RangeRule::widening},
                                           {"fixed", RangeRule::fixed}};
constexpr Name<Overlay> overlays[] = {
    {"normals", Overlay::normals},     {"back-sides", Overlay::back_sides},
    {"cuts", Overlay::cuts},           {"shadow-edges", Overlay::shadows},
    {"wireframe", Overlay::wireframe}, {"smooth", Overlay::smooth}};
constexpr Name<ClipPlane::Axis> axes[] = {
    {"x", ClipPlane::Axis::x}, {"y", ClipPlane::Axis::y}, {"z", ClipPlane::Axis::z}};
constexpr Name<MapKind> algorithms[] = {{"local-map", MapKind::local},
                                        {"global-map", MapKind::global}};
constexpr Name<Phase> phases[] = {
    {"before", Phase::before}, {"split", Phase::split}, {"after", Phase::after}};
constexpr Name<StepName> step_names[] = {
    {"exchange", StepName::exchange}, {"cut", StepName::cut},         {"event", StepName::event},
    {"fullest", StepName::fullest},   {"polygon", StepName::polygon}, {"whole", StepName::whole}};
constexpr Name<Layout> layouts[] = {
    {"teach", Layout::teach}, {"inspect", Layout::inspect}, {"debug", Layout::debug}};

template <class Value, std::size_t n>
Value value_of(const Name<Value> (&names)[n], const json& name, const std::string& where) {
  const auto value =
      name.is_string() ? value_named(names, name.get<std::string>()) : std::optional<Value>();
  if (!value) {
    throw InputError(where + ": must be one of " + names_in_quotes(names));
  }
  return *value;
}

template <class Value, std::size_t n>
void read(JsonObject& object, const char* key, const Name<Value> (&names)[n], Value& value) {
  if (const json* found = object.find(key)) {
    value = value_of(names, *found, object.where(key));
  }
}

Goal goal_from(const json& value, const std::string& where) {
  if (value == "finished") {
    return {Goal::Kind::finished};
  }
  const double passes = value.is_number() ? value.get<double>() : -1;
  constexpr double most_passes = 1e15;
  if (!(passes >= 0 && passes <= most_passes) || passes != std::floor(passes)) {
    throw InputError(where + ": must be \"finished\" or a number of directions");
  }
  if (passes == 0) {
    return {};
  }
  return {Goal::Kind::passes, static_cast<std::int64_t>(passes)};
}

json to_json(const Goal& goal) {
  if (goal.kind == Goal::Kind::passes) {
    return goal.passes;
  }
  return goal.kind == Goal::Kind::pause ? json(0) : json("finished");
}

std::optional<FocusChoice> focus_from(const json& value, const std::string& where) {
  if (value == "newest") {
    return std::nullopt;
  }
  FocusChoice focus;
  JsonObject object(value, where);
  int iteration = 1, direction = 1;
  object.read("iteration", iteration, 1, largest_number);
  object.read("direction", direction, 1, largest_number);
  focus.iteration = iteration - 1;
  focus.direction = direction - 1;
  if (const json* step = object.find("step")) {
    if (step->is_string()) {
      if (*step == "last") {
        focus.step = std::int32_t{largest_number};
      } else {
        focus.step = value_of(step_names, *step, object.where("step"));
      }
    } else {
      int number = 0;
      object.read("step", number, 0, largest_number);
      focus.step = std::int32_t{number - 1};
    }
  }
  read(object, "phase", phases, focus.phase);
  object.done();
  return focus;
}

json to_json(const std::optional<FocusChoice>& focus) {
  if (!focus) {
    return "newest";
  }
  json result = {{"iteration", focus->iteration + 1},
                 {"direction", focus->direction + 1},
                 {"phase", name_in_file(phases, focus->phase)}};
  if (const auto* step = std::get_if<std::int32_t>(&focus->step)) {
    result["step"] = *step == largest_number ? json("last") : json(*step + 1);
  } else {
    result["step"] = name_in_file(step_names, std::get<StepName>(focus->step));
  }
  return result;
}

void read_colors(ViewState& state, const json& value, const std::string& where) {
  JsonObject object(value, where);
  read(object, "quantity", quantities, state.quantity);
  read(object, "show", color_modes, state.color_mode);
  read(object, "map", color_maps, state.color_map);
  if (object.find("logarithmic")) {
    object.read("logarithmic", state.logarithmic.emplace());
  }
  if (const json* range = object.find("range")) {
    const bool two_numbers = range->is_array() && range->size() == 2 && (*range)[0].is_number() &&
                             (*range)[1].is_number();
    if (!two_numbers) {
      object.fail_at("range", "must be two numbers [low, high]");
    }
    state.range = {(*range)[0].get<double>(), (*range)[1].get<double>()};
    state.range_rule = RangeRule::fixed;
  }
  read(object, "range-rule", range_rules, state.range_rule);
  if (state.range_rule == RangeRule::fixed && !state.range) {
    object.fail_at("range-rule", "\"fixed\" requires a \"range\"");
  }
  if (state.range_rule == RangeRule::automatic && state.range) {
    object.fail_at("range-rule", "\"automatic\" excludes a \"range\"");
  }
  if (object.find("exposure")) {
    object.read("exposure", state.exposure.emplace());
  }
  object.read("gamma", state.gamma);
  if (!(state.gamma >= 1 && state.gamma <= 3)) {
    object.fail_at("gamma", "must be from 1 to 3");
  }
  if (state.exposure && !(std::abs(*state.exposure) <= 12)) {
    object.fail_at("exposure", "must be from -12 to 12 EV");
  }
  object.done();
}

ClipPlane clip_from(const json& value, const std::string& where) {
  ClipPlane clip;
  JsonObject object(value, where);
  if (!object.find("axis")) {
    object.fail_at("axis", "is missing");
  }
  read(object, "axis", axes, clip.axis);
  object.read("place", clip.place);
  if (!(clip.place >= 0 && clip.place <= 1)) {
    object.fail_at("place", "must be from 0 to 1");
  }
  object.read("other-side", clip.other_side);
  object.done();
  return clip;
}

json to_json(const ClipPlane& clip) {
  return {{"axis", name_in_file(axes, clip.axis)},
          {"place", clip.place},
          {"other-side", clip.other_side}};
}

void read_overlays(ViewState& state, JsonObject& object) {
  const json* list = object.find("overlays");
  if (!list) {
    return;
  }
  if (!list->is_array()) {
    object.fail_at("overlays", "must be a list of names [\"normals\", …]");
  }
  for (const json& name : *list) {
    state.overlays.push_back(value_of(overlays, name, object.where("overlays")));
  }
}

void read_panels(ViewState& state, JsonObject& object) {
  const json* list = object.find("panels");
  if (!list) {
    return;
  }
  const bool names =
      list->is_array() &&
      std::all_of(list->begin(), list->end(), [](const json& name) { return name.is_string(); });
  if (!names) {
    object.fail_at("panels", "must be a list of names [\"map\", …]");
  }
  state.panels = list->get<std::vector<std::string>>();
}

// A file in `folder` takes precedence over one in the working folder.
std::string scene_path(const std::string& scene, const std::string& folder) {
  if (folder.empty() || scene.empty()) {
    return scene;
  }
  const auto path = std::filesystem::path(folder) / scene;
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? path.string() : scene;
}

}  // namespace

ViewPoint view_point_from_json(const json& value, const std::string& where) {
  ViewPoint camera;
  camera.eye = {0, 0, 1};
  camera.up = {0, 1, 0};
  JsonObject object(value, where);
  object.read("eye", camera.eye);
  object.read("target", camera.target);
  object.read("up", camera.up);
  object.read("angle", camera.view_angle);
  object.done();
  const Vec3 view_axis = camera.target - camera.eye;
  if (!(norm(cross(view_axis, camera.up)) > 1e-9 * norm(view_axis) * norm(camera.up))) {
    object.fail("eye and target must differ, and \"up\" must not lie along the line between them");
  }
  if (!(camera.view_angle > 0 && camera.view_angle < 170)) {
    object.fail_at("angle", "must be between 0 and 170 degrees");
  }
  return camera;
}

json to_json(const ViewPoint& camera) {
  return {{"eye", viewer::to_json(camera.eye)},
          {"target", viewer::to_json(camera.target)},
          {"up", viewer::to_json(camera.up)},
          {"angle", camera.view_angle}};
}

ViewState view_state_from_json(const json& value, const std::string& where,
                               const std::string& folder) {
  ViewState state;
  JsonObject object(value, where);
  object.read("scene", state.scene);
  state.scene = scene_path(state.scene, folder);
  if (const json* options = object.find("options")) {
    state.options = run_options_from_json(*options, object.where("options"));
  }
  if (const json* goal = object.find("solve")) {
    state.solve = goal_from(*goal, object.where("solve"));
  }
  if (const json* focus = object.find("focus")) {
    state.focus = focus_from(*focus, object.where("focus"));
  }
  state.materials = material_changes_from_json(object, "materials");
  object.read("select", state.selection, 0, largest_number);
  state.also_selected = patch_ranges_from_json(object, "also-selected");
  if (!state.also_selected.empty() && state.selection == no_patch) {
    object.fail_at("also-selected", "requires \"select\"");
  }
  state.hidden = patch_ranges_from_json(object, "hidden");
  if (const json* clip = object.find("clip")) {
    state.clip = clip_from(*clip, object.where("clip"));
  }
  if (const json* camera = object.find("camera")) {
    state.camera = view_point_from_json(*camera, object.where("camera"));
  }
  if (const json* colors = object.find("colors")) {
    read_colors(state, *colors, object.where("colors"));
  }
  if (object.find("outlines")) {
    object.read("outlines", state.outlines.emplace());
  }
  object.read("direction", state.direction_shown);
  read_overlays(state, object);
  read(object, "algorithm", algorithms, state.algorithm);
  object.read("labels", state.labels);
  if (object.find("layout")) {
    read(object, "layout", layouts, state.layout.emplace());
  }
  read_panels(state, object);
  object.done();
  return state;
}

json to_json(const ViewState& state) {
  json result = {{"scene", state.scene},
                 {"options", to_json(state.options)},
                 {"solve", to_json(state.solve)},
                 {"focus", to_json(state.focus)},
                 {"colors",
                  {{"quantity", name_in_file(quantities, state.quantity)},
                   {"show", name_in_file(color_modes, state.color_mode)},
                   {"map", name_in_file(color_maps, state.color_map)},
                   {"range-rule", name_in_file(range_rules, state.range_rule)},
                   {"gamma", state.gamma}}},
                 {"overlays", json::array()},
                 {"algorithm", name_in_file(algorithms, state.algorithm)},
                 {"direction", state.direction_shown},
                 {"labels", state.labels}};
  if (state.range) {
    result["colors"]["range"] = json::array({state.range->first, state.range->second});
  }
  if (state.logarithmic) {
    result["colors"]["logarithmic"] = *state.logarithmic;
  }
  if (state.exposure) {
    result["colors"]["exposure"] = *state.exposure;
  }
  for (const Overlay overlay : state.overlays) {
    result["overlays"].push_back(name_in_file(overlays, overlay));
  }
  if (!state.materials.empty()) {
    result["materials"] = to_json(state.materials);
  }
  if (state.selection != no_patch) {
    result["select"] = state.selection;
  }
  if (!state.also_selected.empty()) {
    result["also-selected"] = viewer::to_json(state.also_selected);
  }
  if (!state.hidden.empty()) {
    result["hidden"] = viewer::to_json(state.hidden);
  }
  if (state.clip) {
    result["clip"] = to_json(*state.clip);
  }
  if (state.camera) {
    result["camera"] = to_json(*state.camera);
  }
  if (state.outlines) {
    result["outlines"] = *state.outlines;
  }
  if (state.layout) {
    result["layout"] = name_in_file(layouts, *state.layout);
  }
  if (!state.panels.empty()) {
    result["panels"] = state.panels;
  }
  return result;
}

}  // namespace transillum::viewer
