// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Finds the right answers to a question from the values of the program, and whether a given answer
// is right.
#include <QPolygonF>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "lessons/computed_values.h"
#include "lessons/question.h"

namespace transillum::viewer {

namespace {

constexpr double same = 1e-9;  // relative: values of equal patches differ by rounding

bool uses_direction(const LessonValue& wanted) {
  return is_of_direction(wanted.kind) ||
         std::any_of(wanted.of.begin(), wanted.of.end(), uses_direction);
}

double value_or_nan(const std::optional<LessonValue>& wanted, ComputedValues& computed) {
  return wanted ? computed.value(*wanted) : std::numeric_limits<double>::quiet_NaN();
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

// The area of a patch over its projection.
double on_surface(LessonValue wanted, ComputedValues& computed) {
  wanted.kind = LessonValueKind::projected_area;
  const double projected = computed.value(wanted);
  wanted.kind = LessonValueKind::area;
  return projected > 0 ? computed.value(wanted) / projected : 0;
}

}  // namespace

bool operator==(const GivenAnswer& a, const GivenAnswer& b) {
  return a.choice == b.choice && a.patch == b.patch && a.number == b.number &&
         a.heights == b.heights &&
         std::equal(a.outline.begin(), a.outline.end(), b.outline.begin(), b.outline.end(),
                    [](const Vec2& p, const Vec2& q) { return p.x == q.x && p.y == q.y; });
}

bool is_of_direction(const Question& question) {
  return uses_direction(question.wanted) ||
         std::any_of(question.choices.begin(), question.choices.end(),
                     [](const Question::Choice& choice) {
                       return choice.value && uses_direction(*choice.value);
                     });
}

bool is_given(const Question& question, const GivenAnswer& answer) {
  switch (question.kind) {
    case Question::Kind::choice:
      return answer.choice >= 0;
    case Question::Kind::patch:
      return answer.patch != no_patch;
    case Question::Kind::number:
      return answer.number.has_value();
    case Question::Kind::curve:
      return answer.heights.size() == question.choices.size() &&
             std::all_of(answer.heights.begin(), answer.heights.end(),
                         [](double height) { return height > 0; });
    case Question::Kind::area:
    case Question::Kind::outline:
      break;
  }
  return answer.outline.size() >= 3;
}

Solved solve_question(const Question& question, ComputedValues& computed) {
  Solved solved;
  computed.expect(question.wanted);
  for (const Question::Choice& choice : question.choices) {
    if (choice.value) {
      computed.expect(*choice.value);
    }
  }
  if (question.kind == Question::Kind::patch) {
    solved.values = computed.of_patches(question.wanted);
    solved.right = best_of(solved.values, question.rule, 0);
    return solved;
  }
  if (question.kind != Question::Kind::curve) {
    solved.value = computed.value(question.wanted);
  }
  if (question.kind == Question::Kind::area || question.kind == Question::Kind::outline) {
    solved.region = computed.region(question.wanted);
  }
  if (question.kind == Question::Kind::outline) {
    solved.scale = on_surface(question.wanted, computed);
    solved.value *= solved.scale;
  }
  for (const Question::Choice& choice : question.choices) {
    solved.values.push_back(value_or_nan(choice.value, computed));
  }
  if (question.kind != Question::Kind::choice) {
    return solved;
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
    case Question::Kind::curve:
      return mean_distance(answer.heights, solved.values) <= question.within;
    case Question::Kind::area:
    case Question::Kind::outline:
      break;
  }
  return compare_areas(solved.region, answer.outline).overlap >= question.within;
}

double mean_distance(const std::vector<double>& heights, const std::vector<double>& computed) {
  double sum = 0;
  for (std::size_t k = 0; k < heights.size(); ++k) {
    if (!(heights[k] > 0 && computed.at(k) > 0)) {
      return std::numeric_limits<double>::infinity();
    }
    sum += std::abs(std::log10(heights[k] / computed[k]));
  }
  return heights.empty() ? 0 : sum / static_cast<double>(heights.size());
}

AreaComparison compare_areas(const std::vector<std::vector<Vec2>>& region,
                             const std::vector<Vec2>& outline) {
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
  int both = 0, missed = 0, extra = 0;
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column) {
      const QPointF p(box.left() + (column + 0.5) / samples * box.width(),
                      box.top() + (row + 0.5) / samples * box.height());
      const bool in_drawn = drawn.containsPoint(p, Qt::OddEvenFill);
      const bool in_region = std::any_of(parts.begin(), parts.end(), [&](const QPolygonF& part) {
        return part.containsPoint(p, Qt::OddEvenFill);
      });
      both += in_drawn && in_region ? 1 : 0;
      missed += in_region && !in_drawn ? 1 : 0;
      extra += in_drawn && !in_region ? 1 : 0;
    }
  }
  const int any = both + missed + extra;
  const double cell = box.width() * box.height() / (samples * samples);
  return {any == 0 ? 0 : static_cast<double>(both) / any, missed * cell, extra * cell};
}

}  // namespace transillum::viewer
