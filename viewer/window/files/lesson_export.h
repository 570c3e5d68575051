// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QTimer>
#include <functional>
#include <vector>

#include "lessons/lesson_html.h"
#include "lessons/question_solver.h"
#include "window/base/window_views.h"

class QAction;
class QProgressDialog;

namespace transillum::viewer {

/// Exports the current lesson as HTML: shows its pages one after another, takes the scene and the
/// map of each, and returns to the page that was shown.
class LessonExport : public QObject {
  Q_OBJECT

 public:
  /// @param settled  whether the window shows all of the newest page
  LessonExport(const WindowFrame& frame, LessonPanel& lessons, std::function<bool()> settled);

  QAction* action() const { return action_; }
  /// Writes the file whole, or not at all; errors are also shown in the window.
  void export_to(const QString& path);
  bool busy() const { return !path_.isEmpty(); }

 signals:
  void written(const QString& path);
  /// The export has failed or was canceled; nothing has been written.
  void failed(const QString& message);

 private:
  void choose();
  void show_next();
  void take_when_settled();
  void take_page();
  std::vector<PanelPicture> panels_of(const Lesson::Page& page) const;
  void finish();
  void fail(const QString& message);
  void end();

  WindowFrame frame_;
  LessonPanel& lessons_;
  std::function<bool()> settled_;
  QAction* action_;
  QTimer poll_;
  QProgressDialog* progress_ = nullptr;
  QString path_;  ///< empty while idle
  int lesson_ = 0, page_before_ = 0;
  int quiet_ = 0;  ///< consecutive times that the window was found settled
  std::vector<ShownPage> pages_;
  QuestionSolver solver_;
};

}  // namespace transillum::viewer
