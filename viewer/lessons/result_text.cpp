// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "lessons/result_text.h"

#include <QColor>
#include <QCoreApplication>
#include <cmath>
#include <limits>

#include "support/has_index.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "widgets/theme.h"

namespace transillum::viewer {

namespace {

QString tr(const char* text) { return QCoreApplication::translate("ResultText", text); }

QString verdict_text(const Question& question, const Solved& solved, const GivenAnswer& answer) {
  if (!is_given(question, answer)) {
    return {};
  }
  return is_right(question, solved, answer) ? colored(tr("✓ Right."), theme::good)
                                            : colored(tr("✗ Not this time."), theme::warm);
}

QString ratio_text(const char* text, double ratio) {
  return ' ' + tr(text).arg(QString::number(ratio, 'g', 2));
}

/// Tells the value of a choice, or why a choice without one is wrong.
QString text_of_choice(const Question& question, const Solved& solved, int choice) {
  const double value = at(solved.values, choice);
  if (!std::isfinite(value)) {
    return ' ' + tr("One of the others is right.");
  }
  return question.rule == Question::Rule::nearest && solved.value != 0
             ? ratio_text(
                   QT_TRANSLATE_NOOP("ResultText", "Your choice is %1 times the computed value."),
                   value / solved.value)
             : ' ' + tr("Your choice has %1.").arg(value_text(question, value));
}

/// Why a choice is wrong, or what a number belongs to: the nearest of the usual mistakes. Empty
/// where the lesson does not tell.
QString told_reason(const Question& question, const Solved& solved, const GivenAnswer& answer) {
  const std::string* reason = nullptr;
  if (question.kind == Question::Kind::choice) {
    reason = &at(question.choices, answer.choice).reason;
  } else {
    double nearest = question.within;
    for (std::size_t k = 0; k < question.choices.size(); ++k) {
      const double value = at(solved.values, k);
      const double difference = std::abs(*answer.number - value);
      if (value != 0 && difference <= nearest * std::abs(value)) {
        nearest = difference / std::abs(value);
        reason = &at(question.choices, k).reason;
      }
    }
  }
  return reason && !reason->empty() ? ' ' + QString::fromStdString(*reason).toHtmlEscaped()
                                    : QString();
}

/// Tells the value of a wrong answer.
QString reason_text(const Question& question, const Solved& solved, const GivenAnswer& answer) {
  if (!is_given(question, answer) || is_right(question, solved, answer)) {
    return {};
  }
  if (question.kind == Question::Kind::patch) {
    const double value = has_index(solved.values, answer.patch)
                             ? at(solved.values, answer.patch)
                             : std::numeric_limits<double>::quiet_NaN();
    return ' ' + (std::isfinite(value)
                      ? tr("Patch %1 has %2.").arg(answer.patch).arg(value_text(question, value))
                      : tr("Patch %1 has no such value.").arg(answer.patch));
  }
  if (question.kind == Question::Kind::number) {
    return (solved.value != 0
                ? ratio_text(QT_TRANSLATE_NOOP("ResultText",
                                               "Your number is %1 times the computed value."),
                             *answer.number / solved.value)
                : QString()) +
           told_reason(question, solved, answer);
  }
  if (question.kind == Question::Kind::choice) {
    return text_of_choice(question, solved, answer.choice) + told_reason(question, solved, answer);
  }
  return {};
}

QString curve_text(const Question& question, const Solved& solved, const GivenAnswer& answer,
                   const QString& verdict) {
  if (!is_given(question, answer)) {
    return verdict + tr("The green curve is the program's.");
  }
  const double factor = std::pow(10, mean_distance(answer.heights, solved.values));
  return verdict + tr("Your curve differs from the program's (green) by a factor of %1 on average.")
                       .arg(QString::number(factor, 'g', 2));
}

}  // namespace

QString colored(const QString& text, const QColor& color) {
  return QStringLiteral("<b style='color: %1'>%2</b>").arg(color.name(), text);
}

QString value_text(const Question& question, double value) {
  const QString unit = QString::fromStdString(question.unit);
  const QString number = number_text(question.percent ? 100 * value : value);
  return unit.isEmpty() ? number : number + QStringLiteral(" ") + unit;
}

QString result_text(const Question& question, const Solved& solved, const GivenAnswer& answer) {
  const QString verdict = verdict_text(question, solved, answer) + ' ';
  switch (question.kind) {
    case Question::Kind::choice:
      return verdict +
             (question.rule == Question::Rule::nearest
                  ? tr("The program computes %1.").arg(value_text(question, solved.value))
                  : QString()) +
             reason_text(question, solved, answer);
    case Question::Kind::number:
      return verdict + tr("The program computes %1.").arg(value_text(question, solved.value)) +
             reason_text(question, solved, answer);
    case Question::Kind::patch:
      return solved.right.empty()
                 ? verdict
                 : verdict +
                       tr("The right answer is patch %1, with %2.")
                           .arg(solved.right.front())
                           .arg(value_text(question, at(solved.values, solved.right.front()))) +
                       reason_text(question, solved, answer);
    case Question::Kind::curve:
      return curve_text(question, solved, answer, verdict);
    case Question::Kind::area:
    case Question::Kind::outline:
      break;
  }
  const QString area = tr("The program's region has %1.").arg(value_text(question, solved.value));
  if (!is_given(question, answer)) {
    return verdict + area;
  }
  const AreaComparison compared = compare_areas(solved.region, answer.outline);
  return verdict + area + ' ' +
         tr("Your area overlaps it by %1 %: %2 are missing (pink), %3 are too much (blue).")
             .arg(std::lround(100 * compared.overlap))
             .arg(value_text(question, solved.scale * compared.missed),
                  value_text(question, solved.scale * compared.extra));
}

}  // namespace transillum::viewer
