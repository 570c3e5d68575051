// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <string>

namespace transillum::viewer {

/// The first of several sentences, without its period.
inline QString first_sentence(const std::string& text) {
  const QString first = QString::fromStdString(text).section(QStringLiteral(". "), 0, 0);
  return first.endsWith('.') ? first.chopped(1) : first;
}

}  // namespace transillum::viewer
