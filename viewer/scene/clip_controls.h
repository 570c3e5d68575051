// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <optional>

#include "transillum/vec3.h"

class QCheckBox;
class QComboBox;
class QSlider;

namespace transillum::viewer {

/// A plane that cuts the picture of a scene open.
struct ClipChoice {
  Vec3 normal;       ///< unit vector; what lies on this side is shown
  double share = 0;  ///< how far along the normal, in [0, 1] of the scene's extent
};

/// Controls of the clipping plane: its axis, its place and the side shown.
class ClipControls : public QWidget {
  Q_OBJECT

 public:
  explicit ClipControls(QWidget* parent = nullptr);

  /// None: off.
  std::optional<ClipChoice> choice() const;
  /// Switches from off to x, y, z and back to off.
  void next_axis();

 signals:
  void changed();

 private:
  QComboBox* axis_;
  QSlider* place_;
  QCheckBox* other_side_;
};

}  // namespace transillum::viewer
