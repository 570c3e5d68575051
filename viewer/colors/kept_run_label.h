// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLabel>

#include "colors/color_choice.h"

namespace transillum::viewer {

/// Says over the picture that it is the kept run's, while it is. It takes no room: the two runs are
/// to be compared in one place.
class KeptRunLabel : public QLabel {
  Q_OBJECT

 public:
  KeptRunLabel(const ColorChoice& colors, QWidget* canvas);
};

}  // namespace transillum::viewer
