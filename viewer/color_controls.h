// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <vector>

#include "color_choice.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QSlider;
class QStackedWidget;

namespace transillum::viewer {

class ShowMenu;

/// The strip above the 3-D view: what of the patches becomes colour, and how, and what else is
/// drawn.
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
  /// Puts a tool at the right end, where there is room for it.
  void add_tool(QWidget* tool);
  /// Asks anew how much room all needs, as after a change of fonts.
  void measure();

 signals:
  void direction_toggled(bool shown);
  void outlines_toggled(bool shown);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* make_true_color_page();
  QWidget* make_map_page();
  void fill_quantities();
  /// Of a row without what can be left out, and without the pages.
  int least_width(const QLayout& row) const;
  void leave_out();
  void show_choice();

  ColorChoice& colors_;
  QComboBox* quantity_;
  QComboBox* mode_;
  QStackedWidget* pages_;
  QSlider* exposure_slider_;
  QDoubleSpinBox* exposure_;
  QCheckBox* automatic_;
  QDoubleSpinBox* gamma_;
  QCheckBox* logarithmic_;
  ShowMenu* show_;
  std::vector<QWidget*> spare_;  ///< left out where the strip is narrow, as on a projector
};

}  // namespace transillum::viewer
