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
#include "scene/welcome_page.h"
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
  reading_bar_ = named("reading_bar", new Banner);
  color_controls_ = new ColorControls(colors);
  scene_view_ = named("scene_view", new SceneView(focus, selection, colors, hidden_));
  welcome_ = new WelcomePage;
  connect(welcome_, &WelcomePage::open_clicked, this, &ScenePage::open_clicked);
  connect(welcome_, &WelcomePage::lesson_clicked, this, &ScenePage::lesson_clicked);
  connect(welcome_, &WelcomePage::built_in_clicked, this, &ScenePage::built_in_clicked);
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
  const auto* pointer =
      new PointerLabel(colors, *scene_view_->canvas(), [this](const QPoint& position) {
        const auto hit = scene_view_->hit_at(position);
        return hit ? PointedPatch{hit->patch, hit->point} : PointedPatch{};
      });
  connect(pointer, &PointerLabel::form_factors_requested, &colors,
          &ColorChoice::form_factors_requested);
  camera_ = new CameraMenu(*scene_view_, bookmarks_);
  color_controls_->add_tool(camera_);
  auto* sharp_button = button_for(sharp_->action());
  sharp_button->setObjectName("sharp_button");
  color_controls_->add_tool(sharp_button);

  pages_ = new QStackedWidget;
  pages_->addWidget(welcome_);
  pages_->addWidget(make_scene(selection, colors));
  make_scenes_action();

  auto* layout = make_column(this, {}, 0);
  layout->addWidget(recovery_bar_);
  layout->addWidget(loading_bar_);
  layout->addWidget(banner_);
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
  scene_layout->addWidget(reading_bar_);
  scene_layout->addWidget(light_bar_);
  scene_layout->addWidget(orientation_bar_);
  scene_layout->addWidget(color_controls_);
  scene_layout->addWidget(note);
  scene_layout->addLayout(view_and_bar, 1);
  return scene;
}

void ScenePage::make_scenes_action() {
  scenes_ = new QAction(theme::icon(theme::Icon::scene), tr("Scenes"), this);
  scenes_->setObjectName("scenes");
  scenes_->setCheckable(true);
  scenes_->setChecked(true);
  scenes_->setEnabled(false);  // until a scene is open
  scenes_->setShortcut(QKeySequence(Qt::Key_W));
  scenes_->setToolTip(tr("Show the built-in scenes and the lessons (W)"));
  connect(scenes_, &QAction::toggled, this,
          [this](bool chosen) { pages_->setCurrentIndex(chosen ? 0 : 1); });
  connect(welcome_, &WelcomePage::back_clicked, this, &ScenePage::show_scene);
}

void ScenePage::set_loading(const QString& name) { welcome_->set_loading(name); }

void ScenePage::show_scene() {
  scenes_->setEnabled(true);
  welcome_->show_back_button();
  scenes_->setChecked(false);
}

}  // namespace transillum::viewer
