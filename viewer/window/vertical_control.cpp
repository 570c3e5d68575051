// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/vertical_control.h"

#include <QActionGroup>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <utility>

#include "model/snapshot.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "solve/settings_panel.h"
#include "state/camera_views.h"
#include "widgets/banner.h"
#include "window/base/open_scene.h"
#include "window/files/first_look.h"

namespace transillum::viewer {

VerticalControl::VerticalControl(const WindowFrame& frame, SettingsPanel& settings)
    : QObject(&frame.window), frame_(frame), settings_(settings) {
  make_menu();
  Vertical& vertical = frame_.state.vertical;
  turn_ = frame_.page.vertical_bar()->add_button("turn_upright", tr("Turn upright"));
  connect(turn_, &QPushButton::clicked, &vertical,
          [&vertical] { vertical.choose(vertical.other()); });
  connect(&settings_, &SettingsPanel::zenith_chosen, &vertical, &Vertical::choose);
  connect(&vertical, &Vertical::changed, this, &VerticalControl::follow);
}

void VerticalControl::make_menu() {
  choices_ = new QActionGroup(this);
  QMenu* menu = frame_.page.camera_menu()->addMenu(tr("Vertical"));
  menu->setToolTip(tr("The direction that is up, for the camera, the sky and exported files"));
  for (const NamedAxis& axis : named_axes()) {
    QAction* action = menu->addAction(tr("Vertical %1").arg(QString::fromUtf8(axis.name)));
    action->setObjectName(QStringLiteral("vertical_%1").arg(QString::fromUtf8(axis.name)));
    action->setCheckable(true);
    choices_->addAction(action);
    connect(action, &QAction::triggered, &frame_.state.vertical,
            [this, up = axis.direction] { frame_.state.vertical.choose(up); });
  }
}

void VerticalControl::show_scene(const LoadedScene& loaded) {
  if (std::exchange(spec_, frame_.state.scene.spec()) == frame_.state.scene.spec()) {
    follow();
    return;
  }
  frame_.state.vertical.show_scene(*loaded.scene, known_of(loaded));
}

std::optional<Vec3> VerticalControl::known_of(const LoadedScene& loaded) {
  if (preferred_) {
    return *std::exchange(preferred_, std::nullopt);
  }
  const Sky sky = settings_.solve_options().sky;
  if (sky.is_set() && sky.model != SkyModel::uniform) {
    return sky.up;
  }
  if (is_built_in(loaded.scene->name())) {  // also in a result file
    return initial_view(*loaded.scene, 1).up;
  }
  const QString ending = QFileInfo(QString::fromStdString(loaded.scene->name())).suffix().toLower();
  const bool is_gltf = ending == QLatin1String("glb") || ending == QLatin1String("gltf");
  return is_gltf ? std::optional(Vec3{0, 1, 0}) : std::nullopt;
}

void VerticalControl::follow() {
  const Vertical& vertical = frame_.state.vertical;
  std::size_t number = 0;
  for (QAction* action : choices_->actions()) {
    action->setChecked(named_axes()[number++].direction == vertical.up());
  }
  settings_.set_scene_up(vertical.up());
  frame_.page.scene_view()->set_vertical(vertical.up());
  if (vertical.is_guess()) {
    const bool along_y = vertical.up() == Vec3{0, 1, 0};
    turn_->setText(vertical.is_clear() ? tr("Turn to +y up") : tr("Turn upright"));
    turn_->setToolTip(tr("Take %1 for the vertical; Camera, Vertical has all directions")
                          .arg(along_y ? QStringLiteral("+z") : QStringLiteral("+y")));
    frame_.page.vertical_bar()->show_message(
        Banner::Kind::offer, vertical.is_clear()
                                 ? tr("Shown with +z up, since most level surfaces face it.")
                                 : tr("Shown with +y up; the file does not say what is up."));
  } else {
    frame_.page.vertical_bar()->dismiss();
  }
}

}  // namespace transillum::viewer
