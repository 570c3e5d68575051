// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFont>
#include <QVariant>

namespace transillum::viewer {

/// What a model says of a column's head for a role.
inline QVariant head_cell(int role, const QString& name, const QString& tip) {
  if (role == Qt::DisplayRole) {
    return name;
  }
  if (role == Qt::ToolTipRole) {
    return tip;
  }
  return {};
}

inline QVariant font_cell(bool bold) {
  QFont font;
  font.setBold(bold);
  return font;
}

}  // namespace transillum::viewer
