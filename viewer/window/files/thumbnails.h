// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QPixmap>
#include <QString>
#include <functional>

#include "window/base/window_views.h"

namespace transillum::viewer {

/// Small pictures of the scene files that were open, in the user's folder for caches. A picture is
/// taken when a solve has ended and before another scene is opened.
class Thumbnails : public QObject {
 public:
  /// @param folder  created when the first picture is saved
  /// @param in_lesson  whether the scene is shown as a lesson wants it; it has no picture then
  Thumbnails(const WindowFrame& frame, const QString& folder, std::function<bool()> in_lesson);

  /// The folder that the program uses.
  static QString usual_folder();
  /// The picture of a file; null if there is none.
  QPixmap picture_of(const QString& path) const;

 private:
  void save();
  QString file_for(const QString& path) const;

  WindowFrame frame_;
  QString folder_;
  std::function<bool()> in_lesson_;
};

}  // namespace transillum::viewer
