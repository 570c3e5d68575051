// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "colors/color_choice.h"
#include "widgets/plate.h"

namespace transillum::viewer {

/// A label over the picture while it shows the kept run. It is an overlay, so that both runs are
/// shown at the same place.
class KeptRunLabel : public Plate {
  Q_OBJECT

 public:
  KeptRunLabel(const ColorChoice& colors, QWidget* canvas);
};

}  // namespace transillum::viewer
