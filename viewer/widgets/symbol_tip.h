// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

namespace transillum::viewer {

/// A tool tip that explains a symbol or an equation, with the section of ALGORITHM.md that derives
/// it on a line of its own.
/// @param section number of the section, such as "6.1"; empty if none is to be named
inline QString symbol_tip(const QString& meaning, const char* section) {
  return *section
             ? meaning + QStringLiteral("\nALGORITHM.md, section ") + QString::fromLatin1(section)
             : meaning;
}

}  // namespace transillum::viewer
