// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QToolButton>

#include "state/camera_views.h"

class QAction;
class QMenu;

namespace transillum::viewer {

class SceneView;

/// Menu of viewpoints: standard sides, fitted views and saved views.
class CameraMenu : public QToolButton {
  Q_OBJECT

 public:
  CameraMenu(SceneView& scene_view, CameraBookmarks& bookmarks, QWidget* parent = nullptr);

  /// Checked: a drag rotates as a turntable.
  QAction* turntable() const { return turntable_; }

 private:
  void fill_bookmarks();
  void ask_for_name(std::size_t k);

  SceneView& scene_view_;
  CameraBookmarks& bookmarks_;
  QAction* turntable_;
  QMenu* saved_;
};

}  // namespace transillum::viewer
