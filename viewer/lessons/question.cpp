// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Reading the questions of lesson pages.
#include "lessons/question.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "support/json_object.h"
#include "support/names.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr std::size_t most_choices = 12;
constexpr double default_fraction = 0.1, default_overlap = 0.5, default_distance = 0.3;

constexpr Name<Question::Kind> question_kinds[] = {
    {"choice", Question::Kind::choice},   {"patch", Question::Kind::patch},
    {"number", Question::Kind::number},   {"area", Question::Kind::area},
    {"outline", Question::Kind::outline}, {"curve", Question::Kind::curve}};

// The JSON and the page that a question is read from.
struct Place {
  JsonObject& object;
  const json& options;
  const ViewState& page;

  LessonValue wanted(const json& value, const std::string& where) const {
    return lesson_value_from_json(value, where, options, page);
  }
};

void read_kind(Question& question, JsonObject& object) {
  std::string name;
  object.read("kind", name);
  const auto kind = value_named(question_kinds, name);
  if (!kind) {
    object.fail_at("kind", "must be one of " + names_in_quotes(question_kinds));
  }
  question.kind = *kind;
}

void read_choices(Question& question, const Place& place) {
  const json* list = place.object.find("choices");
  if (!list || !list->is_array() || list->size() < 2 || list->size() > most_choices) {
    place.object.fail_at("choices", "must be a list of 2 to 12 choices");
  }
  int without_value = 0;
  for (const json& value : *list) {
    JsonObject object(value, place.object.where("choices"));
    Question::Choice& choice = question.choices.emplace_back();
    object.read("text", choice.text);
    if (const json* wanted = object.find("value")) {
      choice.value = place.wanted(*wanted, object.where("value"));
      if (is_per_patch(*choice.value)) {
        object.fail_at("value", "must be one number: a patch is missing");
      }
    }
    without_value += choice.value ? 0 : 1;
    if (question.kind == Question::Kind::choice) {
      object.read("reason", choice.reason);
    }
    const bool of_curve = question.kind == Question::Kind::curve;
    if (choice.text.empty() && (of_curve || !choice.value)) {
      object.fail_at("text", "is missing");
    }
    if (of_curve && !(choice.value && is_computed(*choice.value))) {
      object.fail_at("value", "must be computed, since it is a point of the curve");
    }
    object.done();
  }
  if (without_value > 1) {
    place.object.fail_at("choices", "only one choice can be without a \"value\"");
  }
}

void read_mistakes(Question& question, const Place& place) {
  const json* list = place.object.find("mistakes");
  if (!list) {
    return;
  }
  if (!list->is_array() || list->size() > most_choices) {
    place.object.fail_at("mistakes", "must be a list of at most 12 mistakes");
  }
  for (const json& value : *list) {
    JsonObject object(value, place.object.where("mistakes"));
    Question::Choice& mistake = question.choices.emplace_back();
    const json* wanted = object.find("value");
    if (!wanted) {
      object.fail_at("value", "is missing");
    }
    mistake.value = place.wanted(*wanted, object.where("value"));
    if (is_per_patch(*mistake.value)) {
      object.fail_at("value", "must be one number: a patch is missing");
    }
    object.read("reason", mistake.reason);
    if (mistake.reason.empty()) {
      object.fail_at("reason", "is missing");
    }
    object.done();
  }
}

// Reads "largest", "smallest", or an object with one of `rules` and a value.
void read_rule(Question& question, const Place& place, const json& answer) {
  const bool of_patches = question.kind == Question::Kind::patch;
  const std::string wanted =
      of_patches ? "must be {\"largest\": value} or {\"smallest\": value}"
                 : "must be \"largest\", \"smallest\", {\"nearest\": value} or {\"equals\": value}";
  if (!of_patches && (answer == "largest" || answer == "smallest")) {
    question.rule = answer == "largest" ? Question::Rule::largest : Question::Rule::smallest;
    return;
  }
  if (!answer.is_object() || answer.size() != 1) {
    place.object.fail_at("answer", wanted);
  }
  const std::string name = answer.begin().key();
  if (of_patches && (name == "largest" || name == "smallest")) {
    question.rule = name == "largest" ? Question::Rule::largest : Question::Rule::smallest;
  } else if (!of_patches && (name == "nearest" || name == "equals")) {
    question.rule = name == "nearest" ? Question::Rule::nearest : Question::Rule::equals;
  } else {
    place.object.fail_at("answer", wanted);
  }
  question.wanted = place.wanted(*answer.begin(), place.object.where("answer"));
}

// Every answer is computed: one that the file states would be right whatever the program does.
void check_computed(const Question& question, JsonObject& object) {
  const bool of_choices =
      std::any_of(question.choices.begin(), question.choices.end(),
                  [](const auto& choice) { return choice.value && is_computed(*choice.value); });
  if (!is_computed(question.wanted) && !of_choices) {
    object.fail_at("answer", "must be computed, but neither the answer nor a choice is a value");
  }
  const bool of_patches = question.kind == Question::Kind::patch;
  if (is_per_patch(question.wanted) != of_patches) {
    object.fail_at("answer", of_patches ? "the value must omit the patch to be found"
                                        : "the value must be one number: a patch is missing");
  }
  const bool has_region = question.wanted.kind == LessonValueKind::visible_area ||
                          question.wanted.kind == LessonValueKind::projected_area;
  if (is_drawn(question) && !has_region) {
    object.fail_at("answer", "must be a visible-area or a projected-area");
  }
}

double default_within(Question::Kind kind) {
  switch (kind) {
    case Question::Kind::number:
      return default_fraction;
    case Question::Kind::curve:
      return default_distance;
    default:
      return default_overlap;
  }
}

void read_answer(Question& question, const Place& place) {
  const json* answer = place.object.find("answer");
  if (!answer) {
    place.object.fail_at("answer", "is missing");
  }
  if (question.kind == Question::Kind::choice || question.kind == Question::Kind::patch) {
    read_rule(question, place, *answer);
  } else {
    question.wanted = place.wanted(*answer, place.object.where("answer"));
  }
  check_computed(question, place.object);
}

}  // namespace

void check_markdown(const std::string& text, const JsonObject& object, const char* key) {
  constexpr std::size_t longest = std::size_t{64} << 10;
  if (text.size() > longest) {
    object.fail_at(key, "must have at most " + std::to_string(longest) + " bytes; it has " +
                            std::to_string(text.size()));
  }
  const QString rest = web_text(text);
  if (rest.contains("[[") || rest.contains("]]")) {
    object.fail_at(key, "must have one ]] after each [[");
  }
}

QString window_text(const std::string& text) {
  return QString::fromStdString(text).remove("[[").remove("]]");
}

QString web_text(const std::string& text) {
  QString rest = QString::fromStdString(text);
  for (int end = rest.indexOf("]]"); end >= 0; end = rest.indexOf("]]")) {
    const int begin = rest.lastIndexOf("[[", end);
    if (begin < 0) {
      break;
    }
    rest.remove(begin, end + 2 - begin);
  }
  return rest;
}

Question question_from_json(const json& value, const std::string& where, const json& page_state,
                            const ViewState& page, const std::string& folder) {
  Question question;
  JsonObject object(value, where);
  const json none = json::object();
  const auto options = page_state.find("options");
  const Place place{object, options == page_state.end() ? none : *options, page};
  read_kind(question, object);
  object.read("ask", question.ask);
  if (question.ask.empty()) {
    object.fail_at("ask", "is missing");
  }
  check_markdown(question.ask, object, "ask");
  if (question.kind == Question::Kind::choice || question.kind == Question::Kind::curve) {
    read_choices(question, place);
  }
  if (question.kind != Question::Kind::curve) {
    read_answer(question, place);
  }
  if (question.kind == Question::Kind::number) {
    read_mistakes(question, place);
  }
  if (question.kind == Question::Kind::number || is_drawn(question)) {
    question.within = default_within(question.kind);
    object.read("within", question.within);
    if (!(question.within > 0 && question.within <= 1)) {
      object.fail_at("within", "must be above 0 and at most 1");
    }
  }
  object.read("unit", question.unit);
  question.percent = question.unit == "%";
  object.read("then", question.then);
  check_markdown(question.then, object, "then");
  if (const json* show = object.find("show")) {
    if (!show->is_object() || show->contains("scene")) {
      object.fail_at("show", "must be an object { … } without \"scene\"");
    }
    json state = page_state;
    state.merge_patch(*show);
    question.reveal = view_state_from_json(state, object.where("show"), folder);
  }
  object.done();
  return question;
}

bool is_drawn(const Question& question) {
  return question.kind == Question::Kind::area || question.kind == Question::Kind::outline ||
         question.kind == Question::Kind::curve;
}

}  // namespace transillum::viewer
