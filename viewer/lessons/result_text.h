// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

#include "lessons/question.h"

class QColor;

namespace transillum::viewer {

/// A value with the unit of the question.
QString value_text(const Question& question, double value);
/// Rich text: whether the answer is right, if one is given; what the program computes; and how a
/// wrong answer differs from it.
QString result_text(const Question& question, const Solved& solved, const GivenAnswer& answer);
/// Bold rich text.
QString colored(const QString& text, const QColor& color);

}  // namespace transillum::viewer
