// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "widgets/drag_hold.h"

class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace transillum::viewer {

/// A slider with a spin box for the width of a lobe: an exponent, or a roughness. The slider's
/// right end is the sharper one.
class GlossSlider : public QWidget {
  Q_OBJECT

 public:
  explicit GlossSlider(QWidget* parent = nullptr);

  /// Emit no signal.
  void show_exponent(double exponent);
  void show_roughness(double roughness);

 signals:
  /// Emitted before the first moved() of a drag, a press or a key.
  void drag_began();
  /// The exponent or the roughness, whichever is shown.
  void moved(double value);

 private:
  void show_value(double value);
  void change(double value);

  bool is_exponent_ = true;
  QLabel* title_;
  QSlider* slider_;
  QDoubleSpinBox* box_;
  DragHold drag_;
};

}  // namespace transillum::viewer
