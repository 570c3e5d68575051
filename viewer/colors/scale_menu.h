// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolButton>

#include "colors/color_choice.h"

class QButtonGroup;
class QComboBox;
class QLineEdit;

namespace transillum::viewer {

/// A button that shows how the range of the color map is set; its menu sets range and map.
class ScaleMenu : public QToolButton {
  Q_OBJECT

 public:
  explicit ScaleMenu(ColorChoice& colors, QWidget* parent = nullptr);

 private:
  QWidget* make_panel();
  void show_choice();
  void apply_range();

  ColorChoice& colors_;
  QComboBox* map_;
  QButtonGroup* rules_;
  QLineEdit *low_, *high_;
};

}  // namespace transillum::viewer
