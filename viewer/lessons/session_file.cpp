// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Session files: the state of the window, breakpoints, saved views and notes as JSON, saved and
// opened by the user.
#include "lessons/session_file.h"

#include <cmath>
#include <filesystem>

#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr int largest_patch_id = 1 << 30;
constexpr std::size_t longest_list = 1000;

Breakpoint breakpoint_from(const json& value, const std::string& where) {
  Breakpoint breakpoint;
  JsonObject object(value, where);
  std::string kind;
  object.read("kind", kind);
  const auto known = breakpoint_kind(kind);
  if (!known) {
    object.fail_at("kind", "unknown kind " + in_quotes(kind));
  }
  breakpoint.kind = *known;
  object.read("patch", breakpoint.patch, 0, largest_patch_id);
  object.read("other", breakpoint.other, 0, largest_patch_id);
  object.read("value", breakpoint.value);
  if (!std::isfinite(breakpoint.value)) {
    object.fail_at("value", "must be a number");
  }
  object.read("enabled", breakpoint.enabled);
  object.done();
  return breakpoint;
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

json to_json(const Breakpoint& b) {
  return {{"kind", name_of(b.kind)},
          {"patch", b.patch},
          {"other", b.other},
          {"value", b.value},
          {"enabled", b.enabled}};
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
  const json whole = {{"show", to_json(state)},
                      {"breakpoints", breakpoints},
                      {"kept-views", views},
                      {"notes", session.notes},
                      {"docks", session.docks.toBase64().toStdString()}};
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
