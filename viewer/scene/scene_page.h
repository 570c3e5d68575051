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
class BannerStack;
class ColorControls;
class SceneView;
class SharpView;
class StartPage;

/// The center of the window: the first page, or the open scene with its colors.
class ScenePage : public QWidget {
  Q_OBJECT

 public:
  ScenePage(const Focus& focus, Selection& selection, ColorChoice& colors,
            QWidget* parent = nullptr);

  // Bars, one of which is shown at a time.
  Banner* banner() const { return banner_; }
  /// The bar that offers to resume a session.
  Banner* recovery_bar() const { return recovery_bar_; }
  /// The bar that shows the scene that is being loaded.
  Banner* loading_bar() const { return loading_bar_; }
  /// The bars that show what the window offers for the open scene.
  Banner* light_bar() const { return light_bar_; }
  Banner* orientation_bar() const { return orientation_bar_; }
  Banner* solids_bar() const { return solids_bar_; }
  /// The bar that says that faces were divided unasked.
  Banner* division_bar() const { return division_bar_; }
  /// The bar that says which vertical was guessed.
  Banner* vertical_bar() const { return vertical_bar_; }
  /// The bar that says how the file of the open scene was read, if that was remembered.
  Banner* reading_bar() const { return reading_bar_; }
  ColorControls* color_controls() const { return color_controls_; }
  SceneView* scene_view() const { return scene_view_; }
  SharpView* sharp() const { return sharp_; }
  QWidget* sharp_button() const { return sharp_button_; }
  QMenu* camera_menu() const { return camera_->menu(); }
  QAction* turntable_action() const { return camera_->turntable(); }
  HiddenPatches& hidden() { return hidden_; }
  CameraBookmarks& bookmarks() { return bookmarks_; }
  StartPage* start() const { return start_; }
  void show_scene();
  void show_start();
  bool shows_start() const;
  /// Shows the first page, or returns to the scene; checked while the first page is shown.
  QAction* start_action() const { return start_action_; }

 signals:
  void replicas_requested();
  /// The first page is shown, or the scene in its place.
  void start_shown(bool shown);

 private:
  QWidget* make_scene(Selection& selection, ColorChoice& colors);
  void make_start_action();
  void show_page(QWidget* page);

  CameraBookmarks bookmarks_;
  HiddenPatches hidden_;
  CameraMenu* camera_;
  Banner *recovery_bar_, *loading_bar_, *banner_, *light_bar_, *orientation_bar_, *solids_bar_,
      *reading_bar_, *vertical_bar_, *division_bar_;
  BannerStack* bars_;
  QStackedWidget* pages_;
  StartPage* start_;
  QWidget* scene_;
  QAction* start_action_;
  ColorControls* color_controls_;
  SceneView* scene_view_;
  SharpView* sharp_;
  QWidget* sharp_button_;
};

}  // namespace transillum::viewer
