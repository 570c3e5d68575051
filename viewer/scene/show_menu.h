// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The menu "Show", and the controls of the clipping plane in it.
#pragma once

#include <QToolButton>
#include <QWidget>
#include <array>
#include <optional>

#include "scene/scene_overlays.h"
#include "state/view_choices.h"
#include "transillum/at.h"

class QCheckBox;
class QComboBox;
class QSlider;
class QAction;

namespace transillum::viewer {

/// Controls of the clipping plane: its axis, its place and the side shown.
class ClipControls : public QWidget {
  Q_OBJECT

 public:
  explicit ClipControls(QWidget* parent = nullptr);

  /// The chosen clipping plane; not set if clipping is off.
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

/// Menu of what is drawn in addition to the colored patches.
class ShowMenu : public QToolButton {
  Q_OBJECT

 public:
  explicit ShowMenu(QWidget* parent = nullptr);

  QAction* outlines() const { return outlines_; }
  QAction* direction() const { return direction_; }
  ClipControls* clip() const { return clip_; }
  /// Sets whether the quantity shown is linear on patches: smooth shading is then not available.
  void set_linear(bool linear);
  QAction* next_clip_axis() const { return next_clip_axis_; }
  QAction* overlay(Overlay overlay) const { return at(overlays_, overlay); }

 signals:
  void overlay_toggled(transillum::viewer::SceneOverlays::Kind kind, bool shown);
  void wireframe_toggled(bool shown);
  void smooth_toggled(bool shown);

 private:
  QAction *outlines_, *direction_, *next_clip_axis_;
  ClipControls* clip_;
  std::array<QAction*, std::size(all_overlays)> overlays_{};
};

}  // namespace transillum::viewer
