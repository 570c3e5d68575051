// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "colors/color_choice.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QSlider;
class QStackedWidget;

namespace transillum::viewer {

class ShowMenu;

/// The strip above the 3-D view: the quantity shown as color, its color scale, and the Show menu.
/// One row, or two or three where it is narrow.
class ColorControls : public QWidget {
  Q_OBJECT

 public:
  explicit ColorControls(ColorChoice& colors, QWidget* parent = nullptr);

  void toggle_direction();
  void set_direction(bool shown);
  bool direction() const;
  void set_outlines(bool shown);
  bool outlines() const;
  ShowMenu* show_menu() const { return show_; }
  /// Adds a tool at the right end.
  void add_tool(QWidget* tool);

 signals:
  void direction_toggled(bool shown);
  void outlines_toggled(bool shown);
  /// The pop-up of a combo box was closed; the keyboard focus should leave it.
  void list_closed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void make_quantity_row();
  QWidget* make_true_color_page();
  QWidget* make_map_page();
  void fill_quantities();
  /// Chooses the number of rows by the width.
  void arrange();
  void ask_for_height();
  void show_choice();

  ColorChoice& colors_;
  QComboBox* quantity_;
  QComboBox* mode_;
  QGridLayout* grid_;
  int rows_ = 0;
  QWidget* quantity_row_;
  QStackedWidget* pages_;
  QWidget* tools_;
  QLabel* exposure_label_;
  QSlider* exposure_slider_;
  QDoubleSpinBox* exposure_;
  QCheckBox* automatic_;
  QDoubleSpinBox* gamma_;
  QCheckBox* logarithmic_;
  ShowMenu* show_;
};

}  // namespace transillum::viewer
