// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Lessons: JSON files of pages, from the resources built from data/lessons or opened by the user.
#include "lessons/lesson.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <algorithm>

#include "base/json_text.h"
#include "support/json_object.h"
#include "transillum/at.h"

// Resources of a static library have to be registered explicitly; outside any namespace, as the
// macro requires.
static void register_resources() { Q_INIT_RESOURCE(lessons); }

namespace transillum::viewer {

using nlohmann::json;

namespace {

// Limit of the states of all pages together, bytes. Each page holds what earlier pages set.
constexpr std::size_t most_state_bytes = 16 << 20;

/// About what a value takes in a page's state. Recursion is as deep as check_json() allows.
std::size_t bytes_of(const json& value) {
  std::size_t bytes = sizeof(json);
  if (value.is_string()) {
    bytes += value.get_ref<const std::string&>().size();
  }
  if (value.is_structured()) {
    for (const auto& item : value.items()) {
      bytes += item.key().size() + bytes_of(item.value());
    }
  }
  return bytes;
}

// A string, or a list of strings, one per line.
std::string text_from(const json* value, const JsonObject& page) {
  if (!value) {
    page.fail_at("text", "is missing");
  }
  if (value->is_string()) {
    return value->get<std::string>();
  }
  if (!value->is_array()) {
    page.fail_at("text", "must be a string in quotes, or a list of them");
  }
  std::string text;
  for (const json& line : *value) {
    if (!line.is_string()) {
      page.fail_at("text", "each line must be a string in quotes");
    }
    text += line.get<std::string>() + '\n';
  }
  return text;
}

// Applies what a page changes to the state so far; null resets a key to its default. Another scene
// resets everything except layout and panels.
void apply_changes(json& state, const json& show) {
  const auto scene = show.find("scene");
  if (scene != show.end() && state.value("scene", json()) != *scene) {
    json kept = json::object();
    for (const char* key : {"layout", "panels"}) {
      if (state.contains(key)) {
        kept[key] = state[key];
      }
    }
    state = std::move(kept);
  }
  state.merge_patch(show);
}

// {"text": "lamp", "patch": 12}
Callout callout_from(const json& value, const std::string& where) {
  constexpr int largest_patch = 1 << 30;
  Callout callout;
  JsonObject object(value, where);
  object.read("text", callout.text);
  if (callout.text.empty()) {
    object.fail_at("text", "is missing");
  }
  bool direction = false;
  object.read("patch", callout.patch, 0, largest_patch);
  object.read("point", callout.point);
  object.read("direction", direction);
  const int anchors =
      (callout.patch != no_patch ? 1 : 0) + (object.find("point") ? 1 : 0) + (direction ? 1 : 0);
  if (anchors != 1) {
    object.fail("needs one of the keys \"patch\", \"point\" and \"direction\"");
  }
  callout.anchor = direction                   ? Callout::Anchor::direction
                   : callout.patch != no_patch ? Callout::Anchor::patch
                                               : Callout::Anchor::point;
  object.done();
  return callout;
}

std::vector<Callout> callouts_from_json(const json& value, const std::string& where) {
  constexpr std::size_t most_callouts = 50;
  if (!value.is_array() || value.size() > most_callouts) {
    throw InputError(where + ": must be a list of at most 50 callouts");
  }
  std::vector<Callout> callouts;
  for (const json& one : value) {
    callouts.push_back(callout_from(one, where));
  }
  return callouts;
}

// [{"label": "random", "with": {"sampling": "random"}}, …]
ErrorRuns errors_from_json(const json& value, const std::string& where, const json& page_options,
                           const ViewState& page) {
  constexpr std::size_t most_runs = 4;
  if (!value.is_array() || value.empty() || value.size() > most_runs) {
    throw InputError(where + ": must be a list of 1 to 4 runs");
  }
  ErrorRuns runs{{}, 8 * page.options.solve.directions};
  for (const json& one : value) {
    JsonObject object(one, where);
    ErrorRuns::Run& run = runs.runs.emplace_back();
    object.read("label", run.label);
    run.solve = run_from_json(object, page_options, page);
    object.done();
  }
  return runs;
}

// Whether the page may show other patches than its values are about.
bool refines(const Lesson::Page& page) {
  return page.state.options.refine.is_set() ||
         std::any_of(page.controls.begin(), page.controls.end(),
                     [](const PageControl& control) { return control.target == "refine-by"; });
}

}  // namespace

Lesson lesson_from_text(const std::string& text, const std::string& name,
                        const std::string& folder) {
  const json whole = parse_json(text, name);
  JsonObject object(whole, name);
  Lesson lesson;
  object.read("title", lesson.title);
  if (lesson.title.empty()) {
    object.fail_at("title", "is missing");
  }
  object.read("minutes", lesson.minutes, 1, 600);
  object.read("needs", lesson.needs);
  object.read("first-hour", lesson.first_hour);
  const json* pages = object.find("pages");
  if (!pages || !pages->is_array() || pages->empty()) {
    object.fail_at("pages", "must be a list [ … ] of at least one page");
  }
  object.done();

  json state = json::object();
  std::size_t state_bytes = 0;
  for (const json& value : *pages) {
    const std::string where = name + ", page " + std::to_string(lesson.pages.size() + 1);
    JsonObject page_object(value, where);
    Lesson::Page& page = lesson.pages.emplace_back();
    page_object.read("title", page.title);
    page.text = text_from(page_object.find("text"), page_object);
    check_markdown(page.text, page_object, "text");
    if (const json* show = page_object.find("show")) {
      if (!show->is_object()) {
        page_object.fail_at("show", "must be an object { … }");
      }
      apply_changes(state, *show);
    }
    const json* question = page_object.find("question");
    const json* controls = page_object.find("controls");
    const json* errors = page_object.find("errors");
    page_object.read("large", page.large);
    if (const json* callouts = page_object.find("callouts")) {
      page.callouts = callouts_from_json(*callouts, page_object.where("callouts"));
    }
    page_object.done();
    state_bytes += sizeof(Lesson::Page) + bytes_of(state);
    state_bytes += question ? sizeof(Question) + bytes_of(state) : 0;
    if (state_bytes > most_state_bytes) {
      page_object.fail("too much: the pages up to here set more than 16 MiB together");
    }
    page.state = view_state_from_json(state, where, folder);
    for (const Callout& callout : page.callouts) {
      page.state.pointed_at = std::max(page.state.pointed_at, callout.patch);
    }
    if (errors) {
      page.errors = errors_from_json(*errors, page_object.where("errors"),
                                     state.value("options", json()), page.state);
    }
    if (controls) {
      page.controls = controls_from_json(*controls, page_object.where("controls"),
                                         state.value("options", json()), page.text);
    }
    if (question && refines(page)) {
      page_object.fail_at("question", "not on a page whose patches are divided by \"refine-by\"");
    }
    if (question) {
      page.question =
          question_from_json(*question, page_object.where("question"), state, page.state, folder);
      std::vector<std::string>& panels = page.state.panels;
      if (page.question->kind == Question::Kind::area &&
          std::find(panels.begin(), panels.end(), "map") == panels.end()) {
        panels.emplace_back("map");  // the area is drawn there
      }
    }
  }
  return lesson;
}

Lesson read_lesson(const std::string& path) {
  Lesson lesson = lesson_from_text(read_json_file(path), path,
                                   QFileInfo(QString::fromStdString(path)).path().toStdString());
  lesson.file = path;
  return lesson;
}

void check_panels(const Lesson& lesson, const std::string& name,
                  const std::vector<std::string>& panels) {
  for (std::size_t k = 0; k < lesson.pages.size(); ++k) {
    std::vector<std::string> named = lesson.pages[k].state.panels;
    if (!lesson.pages[k].large.empty() && lesson.pages[k].large != "scene") {
      named.push_back(lesson.pages[k].large);
    }
    for (const std::string& panel : named) {
      if (std::find(panels.begin(), panels.end(), panel) != panels.end()) {
        continue;
      }
      std::string known;
      for (const std::string& one : panels) {
        known += (known.empty() ? "" : ", ") + one;
      }
      throw InputError(name + ", page " + std::to_string(k + 1) + ", panels: unknown panel \"" +
                       panel + "\"; known panels: " + known);
    }
  }
}

FirstHour first_hour_of(const std::vector<Lesson>& lessons, int lesson) {
  FirstHour hour;
  for (int k = 0; k < std::ssize(lessons); ++k) {
    if (at(lessons, k).first_hour) {
      ++hour.lessons;
      hour.minutes += at(lessons, k).minutes;
      hour.place = k == lesson ? hour.lessons : hour.place;
    }
  }
  return hour;
}

const std::vector<Lesson>& built_in_lessons() {
  static const std::vector<Lesson> lessons = [] {
    register_resources();
    std::vector<Lesson> all;
    const QDir folder(QStringLiteral(":/lessons"));
    QStringList names = folder.entryList({"*.json"}, QDir::Files, QDir::Name);
    const auto number = [](const QString& name) { return name.section('-', 0, 0).toInt(); };
    std::stable_sort(names.begin(), names.end(), [&](const QString& a, const QString& b) {
      return number(a) < number(b);  // 10 after 9
    });
    for (const QString& name : names) {
      QFile file(folder.filePath(name));
      file.open(QIODevice::ReadOnly);
      all.push_back(lesson_from_text(file.readAll().toStdString(), name.toStdString()));
      all.back().file = name.toStdString();
      all.back().built_in = true;
    }
    return all;
  }();
  return lessons;
}

}  // namespace transillum::viewer
