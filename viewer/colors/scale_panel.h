// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "colors/color_choice.h"

class QButtonGroup;
class QComboBox;
class QLineEdit;

namespace transillum::viewer {

/// Sets the color map and its range.
class ScalePanel : public QWidget {
  Q_OBJECT

 public:
  explicit ScalePanel(ColorChoice& colors, QWidget* parent = nullptr);

 private:
  void make_controls();
  void show_choice();
  void apply_range();

  ColorChoice& colors_;
  QComboBox* map_;
  QButtonGroup* rules_;
  QLineEdit *low_, *high_;
};

}  // namespace transillum::viewer
