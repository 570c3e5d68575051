// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

class QLabel;

namespace transillum::viewer {

/// Rows of a label and a field, one below the other. A hidden row takes no space, other than in a
/// form layout of Qt 5. Labels of all instances are equally wide.
class SettingRows : public QWidget {
 public:
  explicit SettingRows(QWidget* parent = nullptr);

  /// Adds a row.
  /// @param label  with the unit, if there is one; it is also the buddy of the field
  /// @param tip  of the label; and of the field, if that has none
  QLabel* add(const QString& label, QWidget* field, const QString& tip = {});
  /// Adds a widget that takes the whole width.
  void add(QWidget* widget);
  /// Shows or hides the row of a field.
  static void show_row(QWidget* field, bool shown);
};

}  // namespace transillum::viewer
