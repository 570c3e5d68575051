// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "state/view_choices.h"
#include "window/base/window_views.h"

namespace transillum::viewer {

class FileActions;
class FullScreen;
class Thumbnails;

/// Fills the first page, and begins what is chosen there. While it is shown, all panels are hidden.
class StartControl : public QObject {
 public:
  /// The references must outlive this object.
  /// @param thumbnails  pictures of recent files; null for none
  StartControl(const WindowFrame& frame, DockLayouts& docks, FileActions& files,
               LessonPanel& lessons, const FullScreen& full_screen, const Thumbnails* thumbnails);

 private:
  void fill_lessons();
  void fill_recent();
  void show_panels(bool start_shown);
  /// In a window without a scene, a layout begins with one that suits it.
  void begin(Layout layout);

  WindowFrame frame_;
  DockLayouts& docks_;
  FileActions& files_;
  LessonPanel& lessons_;
  const FullScreen& full_screen_;
  const Thumbnails* thumbnails_;
  bool leaves_teaching_ = false;  ///< the next scene is not of a lesson
};

}  // namespace transillum::viewer
