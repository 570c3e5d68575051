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

/// The strip above the 3-D view: what of the patches becomes color, and how, and what else is
/// drawn. Where one row has no room, as on a projector, it is two.
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
  /// Puts a tool at the right end.
  void add_tool(QWidget* tool);

 signals:
  void direction_toggled(bool shown);
  void outlines_toggled(bool shown);
  /// Something was chosen from a list: what is typed next is not meant for it.
  void list_closed();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QWidget* make_true_color_page();
  QWidget* make_map_page();
  void fill_quantities();
  /// Lays all out in the room there is.
  void arrange();
  void show_choice();

  ColorChoice& colors_;
  QComboBox* quantity_;
  QComboBox* mode_;
  QGridLayout* grid_;
  int rows_ = 0;
  QWidget* what_;
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
