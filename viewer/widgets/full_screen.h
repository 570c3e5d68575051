// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAction>
#include <QByteArray>
#include <QList>
#include <QObject>

class QMainWindow;
class QWidget;

namespace transillum::viewer {

/// One view on the whole screen, and back: the one under the pointer, or else the one with the
/// keyboard. Nothing is taken out of the window, only everything else is hidden: views that draw by
/// OpenGL do not survive a change of parents everywhere.
class FullScreen : public QObject {
  Q_OBJECT

 public:
  explicit FullScreen(QMainWindow& window);

  QAction* action() const { return action_; }
  /// A dock of the window or its central widget.
  void show_only(QWidget* view);
  void show_all();
  bool active() const { return active_; }

 private:
  void toggle();
  QWidget* view_of(QWidget* widget) const;

  QMainWindow& window_;
  QAction* action_;
  bool active_ = false;
  bool was_full_ = false;
  QByteArray state_;
  QList<QWidget*> hidden_;  ///< what is no dock
};

}  // namespace transillum::viewer
