// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>
#include <optional>

#include "state/clip_plane.h"

class QCheckBox;
class QComboBox;
class QSlider;

namespace transillum::viewer {

/// Controls of the clipping plane: its axis, its place and the side shown.
class ClipControls : public QWidget {
  Q_OBJECT

 public:
  explicit ClipControls(QWidget* parent = nullptr);

  /// The chosen plane; not set if clipping is off.
  std::optional<ClipPlane> choice() const;
  void set_choice(const std::optional<ClipPlane>& clip);
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
