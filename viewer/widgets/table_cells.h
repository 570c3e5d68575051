// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFont>
#include <QVariant>

namespace transillum::viewer {

/// The data of a column header for a role: name and tool tip.
inline QVariant header_cell(int role, const QString& name, const QString& tip) {
  if (role == Qt::DisplayRole) {
    return name;
  }
  if (role == Qt::ToolTipRole) {
    return tip;
  }
  return {};
}

/// The data for Qt::FontRole.
inline QVariant font_cell(bool bold) {
  QFont font;
  font.setBold(bold);
  return font;
}

}  // namespace transillum::viewer
