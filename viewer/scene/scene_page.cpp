// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/scene_page.h"

#include <QAction>
#include <QStackedWidget>

#include "colors/color_bar.h"
#include "colors/color_note.h"
#include "colors/pointer_label.h"
#include "scene/color_controls.h"
#include "scene/scene_view.h"
#include "scene/sharp_view.h"
#include "scene/show_menu.h"
#include "scene/start_page.h"
#include "widgets/banner.h"
#include "widgets/build.h"
#include "widgets/theme.h"

namespace transillum::viewer {

ScenePage::ScenePage(const Focus& focus, Selection& selection, ColorChoice& colors, QWidget* parent)
    : QWidget(parent) {
  recovery_bar_ = named("recovery_bar", new Banner);
  loading_bar_ = named("loading_bar", new Banner);
  banner_ = new Banner;
  light_bar_ = named("light_bar", new Banner);
  orientation_bar_ = named("orientation_bar", new Banner);
  solids_bar_ = named("solids_bar", new Banner);
  reading_bar_ = named("reading_bar", new Banner);
  vertical_bar_ = named("vertical_bar", new Banner);
  division_bar_ = named("division_bar", new Banner);
  bars_ = new BannerStack;
  for (Banner* bar : {loading_bar_, recovery_bar_, banner_}) {
    bars_->add(bar);
  }
  for (Banner* bar :
       {light_bar_, orientation_bar_, solids_bar_, division_bar_, reading_bar_, vertical_bar_}) {
    bars_->add(bar, true);
  }
  color_controls_ = new ColorControls(colors);
  scene_view_ = named("scene_view", new SceneView(focus, selection, colors, hidden_));
  start_ = new StartPage;
  connect(scene_view_, &SceneView::eye_moved, &colors, &ColorChoice::set_eye);
  connect(color_controls_, &ColorControls::direction_toggled, scene_view_,
          &SceneView::set_direction_shown);
  connect(color_controls_, &ColorControls::outlines_toggled, scene_view_,
          &SceneView::set_outlines_shown);
  connect(color_controls_, &ColorControls::list_closed, scene_view_->canvas(),
          qOverload<>(&QWidget::setFocus));
  const ShowMenu* show = color_controls_->show_menu();
  connect(show, &ShowMenu::overlay_toggled, scene_view_, &SceneView::set_overlay_shown);
  connect(show, &ShowMenu::wireframe_toggled, scene_view_, &SceneView::set_wireframe);
  connect(show->clip(), &ClipControls::changed, scene_view_,
          [this, show] { scene_view_->set_clip(show->clip()->choice()); });
  connect(show, &ShowMenu::smooth_toggled, scene_view_, &SceneView::set_smooth_shading);
  new KeptRunLabel(colors, scene_view_->canvas());
  sharp_ = new SharpView(*scene_view_, this);
  connect(sharp_, &SharpView::wanted_changed, &colors, &ColorChoice::set_fitted);
  const auto* pointer =
      new PointerLabel(colors, *scene_view_->canvas(), [this](const QPoint& position) {
        const auto hit = scene_view_->hit_at(position);
        return hit ? PointedPatch{hit->patch, hit->point} : PointedPatch{};
      });
  connect(pointer, &PointerLabel::form_factors_requested, &colors,
          &ColorChoice::form_factors_requested);
  camera_ = new CameraMenu(*scene_view_, bookmarks_);
  color_controls_->add_tool(camera_);
  sharp_button_ = named("sharp_button", button_for(sharp_->action()));
  color_controls_->add_tool(sharp_button_);

  pages_ = new QStackedWidget;
  scene_ = make_scene(selection, colors);
  pages_->addWidget(start_);
  pages_->addWidget(scene_);
  make_start_action();

  auto* layout = make_column(this, {}, 0);
  layout->addWidget(bars_);
  layout->addWidget(pages_, 1);
}

QWidget* ScenePage::make_scene(Selection& selection, ColorChoice& colors) {
  auto* note = new ColorNote(colors);
  connect(note, &ColorNote::replicas_requested, this, &ScenePage::replicas_requested);
  auto* scene = new QWidget;
  auto* view_and_bar = make_row({}, 0);
  view_and_bar->addWidget(scene_view_, 1);
  auto* bar = new ColorBar(colors);
  connect(bar, &ColorBar::patches_chosen, &selection, &Selection::select_all);
  view_and_bar->addWidget(bar);
  auto* scene_layout = make_column(scene, {}, 0);
  scene_layout->addWidget(color_controls_);
  scene_layout->addWidget(note);
  scene_layout->addLayout(view_and_bar, 1);
  return scene;
}

void ScenePage::make_start_action() {
  start_action_ = make_key_action(this, "start", tr("Start"),
                                  tr("Show the scenes, the lessons and the recent files; the open "
                                     "scene stays"),
                                  Qt::Key_W);
  start_action_->setCheckable(true);
  start_action_->setChecked(true);
  connect(start_action_, &QAction::triggered, this, [this] {
    if (shows_start() && scene_view_->loaded()) {
      show_scene();
    } else {
      show_start();
    }
  });
}

bool ScenePage::shows_start() const { return pages_->currentWidget() == start_; }

void ScenePage::show_scene() { show_page(scene_); }

void ScenePage::show_start() { show_page(start_); }

void ScenePage::show_page(QWidget* page) {
  start_action_->setChecked(page == start_);
  if (pages_->currentWidget() != page) {
    pages_->setCurrentWidget(page);
    bars_->set_scene_shown(page == scene_);
    emit start_shown(page == start_);
  }
}

}  // namespace transillum::viewer
