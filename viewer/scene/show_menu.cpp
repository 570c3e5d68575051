// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/show_menu.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QMenu>
#include <QSlider>
#include <QWidgetAction>

#include "transillum/at.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr int steps = 200;

}  // namespace

ClipControls::ClipControls(QWidget* parent) : QWidget(parent) {
  axis_ = named("clip_axis", new QComboBox,
                tr("The axis that is perpendicular to the clipping plane (X: the next axis)"));
  axis_->addItems({tr("Off"), tr("x"), tr("y"), tr("z")});
  place_ = named("clip_place", new QSlider(Qt::Horizontal), tr("Position of the clipping plane"));
  place_->setRange(0, steps);
  place_->setValue(steps / 2);
  place_->setMinimumWidth(120);
  other_side_ = named("clip_other_side", new QCheckBox(tr("Other side")),
                      tr("Show the other side of the plane"));
  auto* label = new QLabel(tr("Clipping plane"));
  label->setBuddy(axis_);
  auto* row = make_row(this, {14, 6, 14, 8});
  for (QWidget* widget : {static_cast<QWidget*>(label), static_cast<QWidget*>(axis_),
                          static_cast<QWidget*>(place_), static_cast<QWidget*>(other_side_)}) {
    row->addWidget(widget);
  }
  const auto show_state = [this] {
    for (QWidget* widget : {static_cast<QWidget*>(place_), static_cast<QWidget*>(other_side_)}) {
      enable_if(*widget, axis_->currentIndex() > 0, tr("Choose an axis first"));
    }
  };
  show_state();
  connect(axis_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this, show_state] {
    show_state();
    emit changed();
  });
  connect(place_, &QSlider::valueChanged, this, &ClipControls::changed);
  connect(other_side_, &QCheckBox::toggled, this, &ClipControls::changed);
}

std::optional<ClipPlane> ClipControls::choice() const {
  const int axis = axis_->currentIndex();
  if (axis == 0) {
    return std::nullopt;
  }
  return ClipPlane{static_cast<ClipPlane::Axis>(axis - 1),
                   static_cast<double>(place_->value()) / steps, other_side_->isChecked()};
}

void ClipControls::set_choice(const std::optional<ClipPlane>& clip) {
  if (clip) {
    place_->setValue(qRound(clip->place * steps));
    other_side_->setChecked(clip->other_side);
  }
  axis_->setCurrentIndex(clip ? static_cast<int>(clip->axis) + 1 : 0);
}

void ClipControls::next_axis() {
  axis_->setCurrentIndex((axis_->currentIndex() + 1) % axis_->count());
}

ShowMenu::ShowMenu(QWidget* parent) : QToolButton(parent) {
  setObjectName("show");
  setText(tr("Show "));
  setToolTip(tr("Choose what to draw in addition to the colored patches"));
  setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(this);
  menu->setToolTipsVisible(true);
  const auto add = [&](const char* name, const QString& text, const QString& tip) {
    QAction* action = menu->addAction(text);
    action->setObjectName(QString::fromLatin1(name));
    action->setToolTip(tip);
    action->setCheckable(true);
    return action;
  };
  outlines_ = add("show_outlines", tr("Outlines"), tr("Draw the edges of the patches"));
  direction_ = add("show_direction", tr("Direction"),
                   tr("Draw the direction as an arrow with its plane (D).\nIn Inspect, only while "
                      "you step"));
  direction_->setChecked(true);
  const auto add_overlay = [&](Overlay overlay, const char* name, const QString& text,
                               const QString& tip) {
    return at(overlays_, overlay) = add(name, text, tip);
  };
  const auto add_lines = [&](Overlay overlay, SceneOverlays::Kind kind, const char* name,
                             const QString& text, const QString& tip) {
    connect(add_overlay(overlay, name, text, tip), &QAction::toggled, this,
            [this, kind](bool shown) { emit overlay_toggled(kind, shown); });
  };
  add_lines(Overlay::normals, SceneOverlays::Kind::normals, "show_normals", tr("Normals"),
            tr("Draw a line from each patch along its normal"));
  add_lines(Overlay::back_sides, SceneOverlays::Kind::back_sides, "show_back_faces",
            tr("Back sides"), tr("Draw the sides that neither emit nor receive"));
  add_lines(Overlay::cuts, SceneOverlays::Kind::fragments, "show_fragments",
            tr("Cuts of the BSP tree"),
            tr("Draw the fragments of the patches that the BSP tree cuts"));
  add_lines(Overlay::shadows, SceneOverlays::Kind::shadows, "show_shadows", tr("Shadow edges"),
            tr("Draw the edges of the sun's shadows; without a sun, of lamps' shadows along the\n"
               "direction whose map is shown"));
  menu->addSeparator();
  connect(add_overlay(Overlay::wireframe, "show_wireframe", tr("Wireframe"),
                      tr("Draw edges instead of surfaces")),
          &QAction::toggled, this, &ShowMenu::wireframe_toggled);
  connect(add_overlay(Overlay::smooth, "show_smooth", tr("Smooth shading"),
                      tr("Interpolate colors across patches; the solution is constant on each")),
          &QAction::toggled, this, &ShowMenu::smooth_toggled);
  set_linear(false);
  menu->addSeparator();
  clip_ = new ClipControls;
  auto* clip = new QWidgetAction(menu);
  clip->setDefaultWidget(clip_);
  menu->addAction(clip);
  next_clip_axis_ =
      menu->addAction(tr("Clip across the next axis"), clip_, &ClipControls::next_axis, Qt::Key_X);
  next_clip_axis_->setObjectName("clip_next");
  setMenu(menu);
}

void ShowMenu::set_linear(bool linear) {
  QAction* smooth = at(overlays_, Overlay::smooth);
  enable_if(*smooth, !linear,
            tr("The quantity shown is linear on each patch: it is already interpolated"));
}

}  // namespace transillum::viewer
