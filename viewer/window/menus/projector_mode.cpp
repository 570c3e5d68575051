// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/menus/projector_mode.h"

#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>
#include <QTimer>
#include <algorithm>

#include "lessons/lesson_panel.h"
#include "scene/color_controls.h"
#include "scene/scene_page.h"
#include "stepping/timeline_bar.h"
#include "stepping/timeline_lanes.h"
#include "transillum/at.h"
#include "widgets/full_screen.h"
#include "window/base/dock_layouts.h"
#include "window/menus/appearance_actions.h"

namespace transillum::viewer {

ProjectorMode::ProjectorMode(const WindowFrame& frame, DockLayouts& docks, LessonPanel& lessons,
                             FullScreen& full_screen, AppearanceActions& appearance,
                             TimelineBar& timeline)
    : QObject(&frame.window),
      frame_(frame),
      docks_(docks),
      lessons_(lessons),
      full_screen_(full_screen),
      appearance_(appearance),
      timeline_(timeline) {
  // Panels that are hidden temporarily are no part of a layout.
  connect(&full_screen_, &FullScreen::beginning, this, [this] { docks_.hold(true); });
  connect(&full_screen_, &FullScreen::ended, this, [this] { docks_.hold(false); });
  connect(&full_screen_, &FullScreen::left, this, [this] { appearance_.set_projects(false); });
  connect(&lessons_, &LessonPanel::page_shown, this, &ProjectorMode::follow_page);
  connect(&frame_.page, &ScenePage::start_shown, this, &ProjectorMode::follow_page);
  frame_.window.installEventFilter(this);
}

// A window manager gives the window the size of the screen some time after it was asked.
bool ProjectorMode::eventFilter(QObject* watched, QEvent* event) {
  if (projecting_ && watched == &frame_.window && event->type() == QEvent::Resize) {
    QTimer::singleShot(0, this, &ProjectorMode::arrange);
  }
  return QObject::eventFilter(watched, event);
}

void ProjectorMode::follow_appearance() {
  if (appearance_.projects() != projecting_) {
    project(appearance_.projects());
  }
}

void ProjectorMode::follow_page() {
  if (projecting_ && views() != projected_) {
    project(true);
  } else if (projecting_) {
    arrange();  // another panel may be the large one
  }
}

void ProjectorMode::follow_timeline() {
  if (projecting_) {
    arrange();
  }
}

QDockWidget* ProjectorMode::dock(const std::string& panel) const {
  return frame_.window.findChild<QDockWidget*>(QString::fromStdString(panel + "_dock"));
}

QDockWidget* ProjectorMode::large() const {
  return lessons_.lesson() < 0
             ? nullptr
             : dock(at(at(lessons_.lessons(), lessons_.lesson()).pages, lessons_.page()).large);
}

QList<QWidget*> ProjectorMode::views() const {
  QWidget* scene = frame_.window.centralWidget();
  if (frame_.page.shows_start()) {
    return {scene};
  }
  QList<QWidget*> views{dock("timeline")};
  if (lessons_.lesson() < 0) {
    return views << scene;
  }
  views << dock("lesson");
  const Lesson::Page& page = at(at(lessons_.lessons(), lessons_.lesson()).pages, lessons_.page());
  views << scene;
  if (QWidget* large = this->large()) {
    return views << large;
  }
  for (const std::string& panel : page.state.panels) {
    if (page.large.empty() && panel != "timeline" && panel != "lesson") {
      views << dock(panel);
    }
  }
  return views;
}

bool ProjectorMode::shows_scene_and_panels() const { return projected_.size() > 3; }

void ProjectorMode::project(bool on) {
  projecting_ = on;
  timeline_.lanes()->set_thin(on);
  timeline_.setMaximumHeight(QWIDGETSIZE_MAX);
  full_screen_.show_all();
  projected_ = on ? views() : QList<QWidget*>();
  frame_.window.findChild<ColorControls*>()->set_thin(shows_scene_and_panels());
  if (!on) {
    return;
  }
  full_screen_.show_only(projected_);
  for (QWidget* view : projected_) {
    view->show();
  }
  // The call is made once the window has its new size.
  QTimer::singleShot(0, this, &ProjectorMode::arrange);
}

void ProjectorMode::arrange() {
  if (!projecting_ || projected_.size() < 2) {
    return;
  }
  // Beside the page are the scene and a column of panels, or one panel that is larger.
  constexpr double page_fraction = 0.46, panel_fraction = 0.265;
  constexpr double page_beside_large = 0.42, large_fraction = 0.43;
  const int width = frame_.window.width();
  QList<QDockWidget*> docks{dock("lesson")};
  QList<int> widths{static_cast<int>((large() ? page_beside_large : page_fraction) * width)};
  if (auto* beside = qobject_cast<QDockWidget*>(projected_.value(3))) {
    docks << beside;
    widths << static_cast<int>((beside == large() ? large_fraction : panel_fraction) * width);
  }
  frame_.window.resizeDocks(docks, widths, Qt::Horizontal);
  QList<QDockWidget*> column;
  QList<int> heights;
  for (QWidget* view : projected_.mid(3)) {
    column << static_cast<QDockWidget*>(view);
    heights << frame_.window.height();  // equal ones
  }
  frame_.window.resizeDocks(column, heights, Qt::Vertical);
  const int height = timeline_.minimumSizeHint().height();
  timeline_.setMaximumHeight(height);
  frame_.window.resizeDocks({dock("timeline")}, {height}, Qt::Vertical);
}

}  // namespace transillum::viewer
