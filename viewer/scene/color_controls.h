// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "colors/color_choice.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QSlider;
class QStackedWidget;
class QToolButton;

namespace transillum::viewer {

class ShowMenu;

/// The row above the 3-D view: the quantity shown as color, a menu of its color scale, and the Show
/// menu.
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
  /// Shows the quantity and the Show menu only, for a narrow scene.
  void set_thin(bool thin);

 signals:
  void direction_toggled(bool shown);
  void outlines_toggled(bool shown);
  /// The pop-up of a combo box was closed; the keyboard focus should leave it.
  void list_closed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void make_quantity();
  void make_scale_menu();
  QWidget* make_true_color_page();
  QWidget* make_map_page();
  void fill_quantities();
  void show_choice();

  ColorChoice& colors_;
  QComboBox* quantity_;
  QToolButton* scale_;  ///< its menu has the controls of the color scale
  QComboBox* mode_;
  QStackedWidget* pages_;
  QSlider* exposure_slider_;
  QDoubleSpinBox* exposure_;
  QCheckBox* automatic_;
  QDoubleSpinBox* gamma_;
  QCheckBox* logarithmic_;
  ShowMenu* show_;
};

}  // namespace transillum::viewer
