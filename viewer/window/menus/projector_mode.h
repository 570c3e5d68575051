// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QList>
#include <QObject>
#include <string>

#include "window/base/window_views.h"

class QDockWidget;
class QWidget;

namespace transillum::viewer {

class AppearanceActions;
class FullScreen;
class TimelineBar;

/// Projector mode: the page of the lesson, if there is one, what the page shows and a thin timeline
/// on the whole screen. While the whole screen shows some views only, layouts stay as they are.
class ProjectorMode : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  ProjectorMode(const WindowFrame& frame, DockLayouts& docks, LessonPanel& lessons,
                FullScreen& full_screen, AppearanceActions& appearance, TimelineBar& timeline);

  /// Begins or ends projector mode, as the appearance says.
  void follow_appearance();
  /// Gives the timeline the height that it needs now.
  void follow_timeline();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void project(bool on);
  void follow_page();
  void arrange();
  QDockWidget* dock(const std::string& panel) const;
  /// The panel that the page shows large; null without one.
  QDockWidget* large() const;
  /// The timeline, the page, and beside it the scene and the panel that the page wants to be large,
  /// or those that it needs; the first page alone.
  QList<QWidget*> views() const;
  bool shows_scene_and_panels() const;

  WindowFrame frame_;
  DockLayouts& docks_;
  LessonPanel& lessons_;
  FullScreen& full_screen_;
  AppearanceActions& appearance_;
  TimelineBar& timeline_;
  bool projecting_ = false;
  QList<QWidget*> projected_;
};

}  // namespace transillum::viewer
