// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <array>

#include "transillum/vec3.h"
#include "widgets/drag_hold.h"

class QCheckBox;
class QDoubleSpinBox;
class QSlider;

namespace transillum::viewer {

/// Sliders for red, green and blue; they move together, in proportion, or separately.
class ChannelSliders : public QWidget {
  Q_OBJECT

 public:
  /// @param name  prefix of the object names of its parts: name_red, …, name_together
  ChannelSliders(const char* name, const QString& title, int decimals, QWidget* parent = nullptr);

  /// Emits no signal. `most` is the right end of the sliders.
  void show_value(const Rgb& value, double most);

 signals:
  /// Emitted before the first moved() of a drag, a press or a key, however often it repeats.
  void drag_began();
  void moved(const transillum::Rgb& value);

 private:
  void set_channel(std::size_t channel, double value);
  void update_widgets();

  Rgb value_, at_drag_start_;
  double most_ = 1;
  QCheckBox* together_;
  std::array<QSlider*, 3> sliders_;
  std::array<QDoubleSpinBox*, 3> boxes_;
  DragHold drag_;
};

}  // namespace transillum::viewer
