// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/show_menu.h"

#include <QAction>
#include <QMenu>
#include <QWidgetAction>

#include "transillum/at.h"

namespace transillum::viewer {

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
                   tr("Draw the newest direction as an arrow with its plane (D)"));
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
  menu->addSeparator();
  connect(add_overlay(Overlay::wireframe, "show_wireframe", tr("Wireframe"),
                      tr("Draw edges instead of surfaces")),
          &QAction::toggled, this, &ShowMenu::wireframe_toggled);
  connect(add_overlay(Overlay::smooth, "show_smooth", tr("Smooth shading"), QString()),
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
  smooth->setEnabled(!linear);
  smooth->setToolTip(
      linear ? tr("The quantity shown is linear on each patch: it is already interpolated")
             : tr("Interpolate colors across patches; the solution is constant on each"));
}

}  // namespace transillum::viewer
