// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Questions of lesson pages: reading them, and computing what is right.
#include "lessons/question.h"

#include <QPolygonF>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "lessons/figure_values.h"
#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr std::size_t most_choices = 12;
constexpr double default_share = 0.1, default_overlap = 0.5;
constexpr double same = 1e-9;  // relative: values of equal patches differ by rounding

struct KindName {
  const char* name;
  Question::Kind kind;
};
constexpr KindName kinds[] = {{"choice", Question::Kind::choice},
                              {"patch", Question::Kind::patch},
                              {"number", Question::Kind::number},
                              {"area", Question::Kind::area}};

// What a question is read from.
struct Place {
  JsonObject& object;
  const json& options;
  const ViewState& page;

  Figure figure(const json& value, const std::string& where) const {
    return figure_from_json(value, where, options, page);
  }
};

void read_kind(Question& question, JsonObject& object) {
  std::string name, choices;
  object.read("kind", name);
  for (const KindName& known : kinds) {
    if (name == known.name) {
      question.kind = known.kind;
      return;
    }
    choices += (choices.empty() ? "\"" : ", \"") + std::string(known.name) + '"';
  }
  object.fail_at("kind", "must be one of " + choices);
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
    if (const json* figure = object.find("value")) {
      choice.value = place.figure(*figure, object.where("value"));
      if (is_per_patch(*choice.value)) {
        object.fail_at("value", "must be one number: a patch is missing");
      }
    }
    without_value += choice.value ? 0 : 1;
    if (choice.text.empty() && !choice.value) {
      object.fail_at("text", "is missing");
    }
    object.done();
  }
  if (without_value > 1) {
    place.object.fail_at("choices", "only one of them can be without a \"value\"");
  }
}

// "largest", "smallest", or an object with one of `rules` and a figure.
void read_rule(Question& question, const Place& place, const json& answer) {
  const bool of_patches = question.kind == Question::Kind::patch;
  const std::string wanted =
      of_patches
          ? "must be {\"largest\": figure} or {\"smallest\": figure}"
          : "must be \"largest\", \"smallest\", {\"nearest\": figure} or {\"equals\": figure}";
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
  question.figure = place.figure(*answer.begin(), place.object.where("answer"));
}

// Every answer is computed: one that the file states would be right whatever the program does.
void check_computed(const Question& question, JsonObject& object) {
  const bool of_choices =
      std::any_of(question.choices.begin(), question.choices.end(),
                  [](const auto& choice) { return choice.value && is_computed(*choice.value); });
  if (!is_computed(question.figure) && !of_choices) {
    object.fail_at("answer", "must be computed: neither it nor a choice is a figure");
  }
  const bool of_patches = question.kind == Question::Kind::patch;
  if (is_per_patch(question.figure) != of_patches) {
    object.fail_at("answer", of_patches ? "the figure must leave out the patch to be found"
                                        : "the figure must be one number: a patch is missing");
  }
  const bool has_region = question.figure.kind == FigureKind::visible_area ||
                          question.figure.kind == FigureKind::projected_area;
  if (question.kind == Question::Kind::area && !has_region) {
    object.fail_at("answer", "must be a visible-area or a projected-area");
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
    question.figure = place.figure(*answer, place.object.where("answer"));
  }
  check_computed(question, place.object);
}

double value_or_nan(const std::optional<Figure>& figure, FigureValues& figures) {
  return figure ? figures.value(*figure) : std::numeric_limits<double>::quiet_NaN();
}

// The indices of values that are as large (small, near) as any. NaN is never right.
std::vector<int> best_of(const std::vector<double>& values, Question::Rule rule, double target) {
  const auto badness = [&](double value) {
    switch (rule) {
      case Question::Rule::largest:
        return -value;
      case Question::Rule::smallest:
        return value;
      default:
        return std::abs(value - target);
    }
  };
  double best = std::numeric_limits<double>::infinity(), scale = std::abs(target);
  for (const double value : values) {
    if (std::isfinite(value)) {
      best = std::min(best, badness(value));
      scale = std::max(scale, std::abs(value));
    }
  }
  const double limit = rule == Question::Rule::equals ? 0 : best;
  std::vector<int> right;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k]) && badness(values[k]) <= limit + same * scale) {
      right.push_back(static_cast<int>(k));
    }
  }
  return right;
}

}  // namespace

bool operator==(const GivenAnswer& a, const GivenAnswer& b) {
  return a.choice == b.choice && a.patch == b.patch && a.number == b.number &&
         std::equal(a.outline.begin(), a.outline.end(), b.outline.begin(), b.outline.end(),
                    [](const Vec2& p, const Vec2& q) { return p.x == q.x && p.y == q.y; });
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
  if (question.kind == Question::Kind::choice) {
    read_choices(question, place);
  }
  read_answer(question, place);
  if (question.kind == Question::Kind::number || question.kind == Question::Kind::area) {
    question.within = question.kind == Question::Kind::number ? default_share : default_overlap;
    object.read("within", question.within);
    if (!(question.within > 0 && question.within <= 1)) {
      object.fail_at("within", "must be above 0 and at most 1");
    }
  }
  object.read("unit", question.unit);
  question.percent = question.unit == "%";
  object.read("then", question.then);
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

bool is_given(const Question& question, const GivenAnswer& answer) {
  switch (question.kind) {
    case Question::Kind::choice:
      return answer.choice >= 0;
    case Question::Kind::patch:
      return answer.patch != no_patch;
    case Question::Kind::number:
      return answer.number.has_value();
    case Question::Kind::area:
      break;
  }
  return answer.outline.size() >= 3;
}

Solved solve_question(const Question& question, FigureValues& figures) {
  Solved solved;
  if (question.kind == Question::Kind::patch) {
    solved.values = figures.of_patches(question.figure);
    solved.right = best_of(solved.values, question.rule, 0);
    return solved;
  }
  solved.value = figures.value(question.figure);
  if (question.kind == Question::Kind::area) {
    solved.region = figures.region(question.figure);
  }
  if (question.kind != Question::Kind::choice) {
    return solved;
  }
  for (const Question::Choice& choice : question.choices) {
    solved.values.push_back(value_or_nan(choice.value, figures));
  }
  solved.right = best_of(solved.values, question.rule, solved.value);
  if (solved.right.empty()) {
    const auto last = std::find_if(question.choices.begin(), question.choices.end(),
                                   [](const auto& choice) { return !choice.value; });
    if (last != question.choices.end()) {
      solved.right.push_back(static_cast<int>(last - question.choices.begin()));
    }
  }
  return solved;
}

bool is_right(const Question& question, const Solved& solved, const GivenAnswer& answer) {
  const auto listed = [&](int index) {
    return std::binary_search(solved.right.begin(), solved.right.end(), index);
  };
  switch (question.kind) {
    case Question::Kind::choice:
      return listed(answer.choice);
    case Question::Kind::patch:
      return listed(answer.patch);
    case Question::Kind::number:
      return std::abs(*answer.number - solved.value) <=
             question.within * std::abs(solved.value) * (1 + same);
    case Question::Kind::area:
      break;
  }
  return overlap(solved.region, answer.outline) >= question.within;
}

double overlap(const std::vector<std::vector<Vec2>>& region, const std::vector<Vec2>& outline) {
  const auto polygon_of = [](const std::vector<Vec2>& corners) {
    QPolygonF polygon;
    for (const Vec2& p : corners) {
      polygon << QPointF(p.x, p.y);
    }
    return polygon;
  };
  std::vector<QPolygonF> parts;
  const QPolygonF drawn = polygon_of(outline);
  QRectF box = drawn.boundingRect();
  for (const auto& part : region) {
    box |= parts.emplace_back(polygon_of(part)).boundingRect();
  }
  constexpr int samples = 256;  // per side
  int both = 0, any = 0;
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const QPointF p(box.left() + (column + 0.5) / samples * box.width(),
                      box.top() + (row + 0.5) / samples * box.height());
      const bool in_drawn = drawn.containsPoint(p, Qt::OddEvenFill);
      const bool in_region = std::any_of(parts.begin(), parts.end(), [&](const QPolygonF& part) {
        return part.containsPoint(p, Qt::OddEvenFill);
      });
      both += in_drawn && in_region ? 1 : 0;
      any += in_drawn || in_region ? 1 : 0;
    }
  }
  return any == 0 ? 0 : static_cast<double>(both) / any;
}

}  // namespace transillum::viewer
