// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene_page.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QVBoxLayout>

#include "banner.h"
#include "color_bar.h"
#include "color_controls.h"
#include "scene_view.h"
#include "show_menu.h"
#include "theme.h"
#include "welcome_page.h"

namespace transillum::viewer {

namespace {

QString words_on_file(const LoadedScene& loaded) {
  const QString name = QFileInfo(QString::fromStdString(loaded.file)).fileName();
  return loaded.stored->complete
             ? ScenePage::tr("Figures of the file %1. Run (F5) solves its scene from zero.")
                   .arg(name)
             : ScenePage::tr(
                   "Figures of the file %1, of a solve that was stopped early. Run (F5) "
                   "solves its scene from zero.")
                   .arg(name);
}

}  // namespace

ScenePage::ScenePage(const Focus& focus, Selection& selection, ColorChoice& colors, QWidget* parent)
    : QWidget(parent) {
  banner_ = new Banner;
  color_controls_ = new ColorControls(colors);
  scene_view_ = new SceneView(focus, selection, colors);
  scene_view_->setObjectName("scene_view");
  auto* welcome = new WelcomePage;
  connect(welcome, &WelcomePage::open_clicked, this, &ScenePage::open_clicked);
  connect(welcome, &WelcomePage::lesson_clicked, this, &ScenePage::lesson_clicked);
  connect(welcome, &WelcomePage::built_in_clicked, this, &ScenePage::built_in_clicked);
  connect(color_controls_, &ColorControls::direction_toggled, scene_view_,
          &SceneView::set_direction_shown);
  connect(color_controls_, &ColorControls::outlines_toggled, scene_view_,
          &SceneView::set_outlines_shown);
  const ShowMenu* show = color_controls_->show_menu();
  connect(show, &ShowMenu::overlay_toggled, scene_view_, &SceneView::set_overlay_shown);
  connect(show, &ShowMenu::wireframe_toggled, scene_view_, &SceneView::set_wireframe);
  connect(show, &ShowMenu::smooth_toggled, scene_view_, &SceneView::set_smooth_shading);
  camera_ = new CameraMenu(*scene_view_, bookmarks_);
  color_controls_->add_tool(camera_);

  note_ = new QLabel;
  note_->setObjectName("color_note");
  note_->setAlignment(Qt::AlignCenter);
  note_->setWordWrap(true);
  note_->setContentsMargins(10, 5, 10, 5);
  QPalette dark = note_->palette();
  dark.setColor(QPalette::Window, theme::scene_background.lighter(140));
  dark.setColor(QPalette::WindowText, theme::on_dark);
  note_->setPalette(dark);
  note_->setAutoFillBackground(true);
  const auto show_note = [this, &colors] {
    const auto snapshot = colors.snapshot();
    const QString note = colors.shows_kept_run() ? tr("A, the kept run, while the key is down")
                         : snapshot && snapshot->of_file && colors.missing().isEmpty()
                             ? words_on_file(*snapshot->loaded)
                             : colors.missing();
    note_->setText(note);
    note_->setVisible(!note.isEmpty());
  };
  connect(&colors, &ColorChoice::changed, note_, show_note);
  connect(&colors, &ColorChoice::fitted, note_, show_note);
  note_->hide();

  auto* scene = new QWidget;
  auto* with_bar = new QHBoxLayout;
  with_bar->setSpacing(0);
  with_bar->addWidget(scene_view_, 1);
  with_bar->addWidget(new ColorBar(colors));
  auto* scene_layout = new QVBoxLayout(scene);
  scene_layout->setContentsMargins(0, 0, 0, 0);
  scene_layout->setSpacing(0);
  scene_layout->addWidget(color_controls_);
  scene_layout->addWidget(note_);
  scene_layout->addLayout(with_bar, 1);
  pages_ = new QStackedWidget;
  pages_->addWidget(welcome);
  pages_->addWidget(scene);

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(banner_);
  layout->addWidget(pages_, 1);
}

void ScenePage::show_scene() { pages_->setCurrentIndex(1); }

}  // namespace transillum::viewer
