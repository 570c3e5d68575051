// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDialog>

#include "window/files/figure.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace transillum::viewer {

/// Asks what a figure shows.
class FigureDialog : public QDialog {
  Q_OBJECT

 public:
  /// @param plan  the first values of the fields
  /// @param has_map  whether there is a map
  FigureDialog(const FigurePlan& plan, bool has_map, QWidget* parent = nullptr);

  FigurePlan plan() const;

 private:
  void make_fields(const FigurePlan& plan);
  void change_unit();
  void show_state();

  QCheckBox *scene_, *map_, *chart_, *explained_, *direction_;
  QLineEdit* title_;
  QDoubleSpinBox *width_, *height_, *text_;
  QComboBox *unit_, *background_;
  QLabel* note_;
  QPushButton* save_;
};

}  // namespace transillum::viewer
