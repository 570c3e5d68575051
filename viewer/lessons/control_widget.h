// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "lessons/page_control.h"

class QComboBox;
class QLabel;
class QSlider;

namespace transillum::viewer {

class Focus;
class MaterialEdits;

/// One control in the text of a page. It drives the window at once, and follows it.
class ControlWidget : public QWidget {
  Q_OBJECT

 public:
  /// The references must outlive the widget.
  ControlWidget(PageControl control, Focus& focus, MaterialEdits& edits, QWidget* parent = nullptr);

  const PageControl& control() const { return control_; }
  /// Sets the font of the values: the font of the text around them.
  void set_text_font(const QFont& font);
  /// Shows the value of an option.
  void show_options(const RunOptions& options);

 signals:
  /// @param value  as in PageControl::values
  void option_chosen(const std::string& name, const std::string& value);

 private:
  void make_slider();
  void make_choice();
  void moved(int position);
  void follow_focus();
  void follow_edits();
  void show_position(int position);
  /// The value of the gray at a position of the slider.
  double gray_at(int position) const;

  PageControl control_;
  Focus& focus_;
  MaterialEdits& edits_;
  QSlider* slider_ = nullptr;
  QComboBox* choice_ = nullptr;
  QLabel* value_ = nullptr;
};

}  // namespace transillum::viewer
