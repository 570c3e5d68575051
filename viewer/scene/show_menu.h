// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolButton>
#include <array>

#include "scene/clip_controls.h"
#include "scene/scene_overlays.h"
#include "state/overlay.h"
#include "transillum/at.h"

class QAction;

namespace transillum::viewer {

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
