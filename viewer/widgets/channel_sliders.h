// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <array>

#include "transillum/vec3.h"

class QCheckBox;
class QDoubleSpinBox;
class QSlider;

namespace transillum::viewer {

/// Sliders for red, green and blue, which move together, in proportion, or alone.
class ChannelSliders : public QWidget {
  Q_OBJECT

 public:
  /// `name` begins the names of its parts: name_red and so on, name_together.
  ChannelSliders(const char* name, const QString& title, int decimals, QWidget* parent = nullptr);

  /// Tells nobody.
  void show_value(const Rgb& value, double most);

 signals:
  void drag_began();
  void moved(const transillum::Rgb& value);

 private:
  void take(std::size_t channel, double value);
  void show_all();

  Rgb value_, when_begun_;
  double most_ = 1;
  QCheckBox* together_;
  std::array<QSlider*, 3> sliders_;
  std::array<QDoubleSpinBox*, 3> boxes_;
};

}  // namespace transillum::viewer
