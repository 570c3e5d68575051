// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>

#include "window/base/window_views.h"

class QSize;

namespace transillum::viewer {

class AppearanceActions;
class FileActions;
class LessonPanel;

/// Layout, appearance and choices of the window, in the settings of the program: the values of the
/// last run are restored, and the values of this run are saved for the next.
class LayoutMemory : public QObject {
 public:
  /// The references must outlive this object.
  LayoutMemory(const WindowFrame& frame, DockLayouts& docks, AppearanceActions& appearance,
               FileActions& files, LessonPanel& lessons);

  void restore();
  void save();

 private:
  /// Resizes the window to `wanted`, or less where the screen is smaller.
  void fit_into_screen(const QSize& wanted);
  void fit_once_shown();

  WindowFrame frame_;
  DockLayouts& docks_;
  AppearanceActions& appearance_;
  FileActions& files_;
  LessonPanel& lessons_;
};

}  // namespace transillum::viewer
