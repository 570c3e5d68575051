// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

class QGridLayout;
class QLabel;

namespace transillum::viewer {

/// Rows of a name with its unit, and a value.
class ValueGrid : public QWidget {
  Q_OBJECT

 public:
  explicit ValueGrid(QWidget* parent = nullptr);

  /// Returns the label of the value; its text can be selected and copied.
  QLabel* add_row(const QString& name, const QString& unit, const QString& tip = {});
  /// Adds a row across all columns.
  void add_wide(QWidget* widget);

 private:
  QGridLayout* grid_;
};

}  // namespace transillum::viewer
