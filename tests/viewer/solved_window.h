// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAction>
#include <QLabel>

#include "window_support.h"

namespace transillum::viewer::test {

/// A window with a scene whose first iteration is done and shown.
struct SolvedWindow {
  std::unique_ptr<TestWindow> window;
  SceneView* scene_view = nullptr;
  MapView* map_view = nullptr;
  bool ready = false;

  explicit SolvedWindow(const QString& scene,
                        const SolveOptions& options = {.directions = 32, .first_shot = {}}) {
    window = make_window(options);
    scene_view = window->findChild<SceneView*>();
    map_view = window->findChild<MapView*>();
    window->open(scene, {Goal::Kind::iteration});
    ready = wait_for([this] {
              return window->snapshot() && window->snapshot()->progress.iteration == 1;
            }) &&
            comes_to_rest(*window);
  }

  /// The picture of the scene, when nothing changes it any more; null where that does not come.
  QImage picture() const {
    return comes_to_rest(*window) ? scene_view->canvas()->grab().toImage() : QImage();
  }

  QString text(const char* label) const { return window->findChild<QLabel*>(label)->text(); }
  void trigger(const char* action) const { window->findChild<QAction*>(action)->trigger(); }
};

}  // namespace transillum::viewer::test
