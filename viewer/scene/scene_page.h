// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QWidget>

#include "colors/color_choice.h"
#include "scene/camera_menu.h"
#include "state/focus.h"
#include "state/hidden_patches.h"
#include "state/selection.h"

class QAction;
class QStackedWidget;

namespace transillum::viewer {

class Banner;
class ColorControls;
class SceneView;
class SharpView;
class WelcomePage;

/// The center of the window: first the scenes to choose from, then the open scene with its colors.
class ScenePage : public QWidget {
  Q_OBJECT

 public:
  ScenePage(const Focus& focus, Selection& selection, ColorChoice& colors,
            QWidget* parent = nullptr);

  Banner* banner() const { return banner_; }
  /// The topmost bar: it offers to resume a session.
  Banner* recovery_bar() const { return recovery_bar_; }
  /// The bar above banner(): it shows the scene that is being loaded.
  Banner* loading_bar() const { return loading_bar_; }
  /// Names the scene that is being loaded on the page where scenes are chosen; empty if none is.
  void set_loading(const QString& name);
  /// The bars below banner(): they show what the window offers for the open scene.
  Banner* light_bar() const { return light_bar_; }
  Banner* orientation_bar() const { return orientation_bar_; }
  /// The bar that says that faces were divided unasked.
  Banner* division_bar() const { return division_bar_; }
  /// The bar that says which vertical was guessed.
  Banner* vertical_bar() const { return vertical_bar_; }
  /// The bar that says how the file of the open scene was read, if that was remembered.
  Banner* reading_bar() const { return reading_bar_; }
  ColorControls* color_controls() const { return color_controls_; }
  SceneView* scene_view() const { return scene_view_; }
  SharpView* sharp() const { return sharp_; }
  QMenu* camera_menu() const { return camera_->menu(); }
  QAction* turntable_action() const { return camera_->turntable(); }
  HiddenPatches& hidden() { return hidden_; }
  CameraBookmarks& bookmarks() { return bookmarks_; }
  /// Shows the open scene in place of the scenes to choose from.
  void show_scene();
  /// Switches between the scenes to choose from and the open scene.
  QAction* scenes_action() const { return scenes_; }

 signals:
  void open_clicked();
  void lesson_clicked();
  void built_in_clicked(const QString& name);
  void replicas_requested();

 private:
  QWidget* make_scene(Selection& selection, ColorChoice& colors);
  void make_scenes_action();

  CameraBookmarks bookmarks_;
  HiddenPatches hidden_;
  CameraMenu* camera_;
  Banner *recovery_bar_, *loading_bar_, *banner_, *light_bar_, *orientation_bar_, *reading_bar_,
      *vertical_bar_, *division_bar_;
  QStackedWidget* pages_;
  WelcomePage* welcome_;
  QAction* scenes_;
  ColorControls* color_controls_;
  SceneView* scene_view_;
  SharpView* sharp_;
};

}  // namespace transillum::viewer
