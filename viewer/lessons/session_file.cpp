// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Session files: the state of the window, breakpoints, watches, saved views and notes as JSON,
// saved and opened by the user.
#include "lessons/session_file.h"

#include <cmath>
#include <filesystem>

#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr int largest_patch_id = 1 << 30;
constexpr std::size_t longest_list = 1000;

Condition read_condition(JsonObject& object) {
  Condition condition;
  std::string kind;
  object.read("kind", kind);
  const auto known = breakpoint_kind(kind);
  if (!known) {
    object.fail_at("kind", "unknown kind " + in_quotes(kind));
  }
  condition.kind = *known;
  object.read("patch", condition.patch, 0, largest_patch_id);
  object.read("other", condition.other, 0, largest_patch_id);
  object.read("value", condition.value);
  if (!std::isfinite(condition.value)) {
    object.fail_at("value", "must be a number");
  }
  return condition;
}

Breakpoint::Further further_from(const json& value, const std::string& where) {
  JsonObject object(value, where);
  std::string join;
  object.read("join", join);
  if (join != "and" && join != "or") {
    object.fail_at("join", "must be \"and\" or \"or\"");
  }
  const Breakpoint::Further further{join == "or", read_condition(object)};
  object.done();
  return further;
}

CameraBookmarks::Bookmark saved_view_from(const json& value, const std::string& where) {
  JsonObject object(value, where);
  std::string name;
  object.read("name", name);
  if (name.empty()) {
    object.fail_at("name", "is missing");
  }
  const json* camera = object.find("camera");
  if (!camera) {
    object.fail_at("camera", "is missing");
  }
  object.done();
  return {QString::fromStdString(name), view_point_from_json(*camera, object.where("camera"))};
}

template <class Item>
void read_list(JsonObject& object, const char* key, const std::string& item,
               std::vector<Item>& items, Item (*from)(const json&, const std::string&)) {
  const json* list = object.find(key);
  if (!list) {
    return;
  }
  if (!list->is_array()) {
    object.fail_at(key, "must be a list [ … ]");
  }
  if (list->size() > longest_list) {
    object.fail_at(key, "must be a list of at most " + std::to_string(longest_list));
  }
  for (const json& value : *list) {
    items.push_back(from(value, object.where(item + ' ' + std::to_string(items.size() + 1))));
  }
}

Breakpoint breakpoint_from(const json& value, const std::string& where) {
  JsonObject object(value, where);
  Breakpoint breakpoint{read_condition(object), true, {}, 1};
  object.read("enabled", breakpoint.enabled);
  object.read("stop-at", breakpoint.stop_at, 1, Breakpoint::most_hits);
  read_list(object, "further", "condition", breakpoint.further, further_from);
  object.done();
  return breakpoint;
}

Watch watch_from(const json& value, const std::string& where) {
  JsonObject object(value, where);
  std::string name;
  object.read("kind", name);
  const auto kind = watch_kind(name);
  if (!kind) {
    object.fail_at("kind", "unknown kind " + in_quotes(name));
  }
  Watch watch{*kind, no_patch};
  if (*kind == Watch::Kind::patch_area) {
    watch.patch = 0;
    object.read("patch", watch.patch, 0, largest_patch_id);
  }
  object.done();
  return watch;
}

json to_json(const Watch& watch) {
  json value = {{"kind", name_of(watch.kind)}};
  if (watch.kind == Watch::Kind::patch_area) {
    value["patch"] = watch.patch;
  }
  return value;
}

json to_json(const Condition& c) {
  return {{"kind", name_of(c.kind)}, {"patch", c.patch}, {"other", c.other}, {"value", c.value}};
}

json to_json(const Breakpoint& b) {
  json value = to_json(b.condition);
  value["enabled"] = b.enabled;
  if (b.stop_at != 1) {
    value["stop-at"] = b.stop_at;
  }
  for (const auto& [alternative, condition] : b.further) {
    json further = to_json(condition);
    further["join"] = alternative ? "or" : "and";
    value["further"].push_back(further);
  }
  return value;
}

std::string relative_to(const std::string& scene, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::exists(scene, error)) {
    return scene;  // a built-in scene
  }
  const fs::path path = fs::relative(fs::absolute(scene), fs::absolute(folder), error);
  if (error || path.empty() || *path.begin() == "..") {
    return fs::absolute(scene).string();
  }
  return path.string();
}

}  // namespace

Session session_from_text(const std::string& text, const std::string& name,
                          const std::string& folder) {
  const json whole = parse_json(text, name);
  JsonObject object(whole, name);
  Session session;
  const json* show = object.find("show");
  if (!show) {
    object.fail_at("show", "is missing");
  }
  session.state = view_state_from_json(*show, object.where("show"), folder);
  read_list(object, "breakpoints", "breakpoint", session.breakpoints, breakpoint_from);
  read_list(object, "kept-views", "saved view", session.saved_views, saved_view_from);
  read_list(object, "watches", "watch", session.watches, watch_from);
  if (session.watches.size() > Watches::most) {
    object.fail_at("watches", "must be a list of at most " + std::to_string(Watches::most));
  }
  object.read("notes", session.notes);
  std::string docks;
  object.read("docks", docks);
  session.docks = QByteArray::fromBase64(QByteArray::fromStdString(docks));
  object.done();
  return session;
}

std::string to_text(const Session& session, const std::string& folder) {
  ViewState state = session.state;
  state.scene = relative_to(state.scene, folder);
  json breakpoints = json::array();
  for (const Breakpoint& b : session.breakpoints) {
    breakpoints.push_back(to_json(b));
  }
  json views = json::array();
  for (const auto& [name, view] : session.saved_views) {
    views.push_back({{"name", name.toStdString()}, {"camera", to_json(view)}});
  }
  json watches = json::array();
  for (const Watch& watch : session.watches) {
    watches.push_back(to_json(watch));
  }
  const json whole = {{"show", to_json(state)}, {"breakpoints", breakpoints},
                      {"watches", watches},     {"kept-views", views},
                      {"notes", session.notes}, {"docks", session.docks.toBase64().toStdString()}};
  return whole.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

JsonFile kind_of_json(const std::string& text, const std::string& name) {
  const json whole = parse_json(text, name);
  if (whole.is_object() && whole.contains("pages")) {
    return JsonFile::lesson;
  }
  if (whole.is_object() && whole.contains("show")) {
    return JsonFile::session;
  }
  throw InputError(name + ": neither a session (with \"show\") nor a lesson (with \"pages\")");
}

}  // namespace transillum::viewer
