// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLocale>
#include <QString>

#include "options/option_table.h"
#include "support/number_text.h"

namespace transillum::viewer {

/// The help of an option as a tool tip. It is rich text, so that Qt wraps long lines.
inline QString setting_tip(const char* setting) {
  const QString sentence = capitalized(QString::fromStdString(option(setting).help));
  return QStringLiteral("<span>%1</span>").arg(sentence.toHtmlEscaped());
}

/// The shortest digits that read back bit for bit.
inline QString exact_digits(double value) {
  return QString::number(value, 'g', QLocale::FloatingPointShortest);
}

}  // namespace transillum::viewer
