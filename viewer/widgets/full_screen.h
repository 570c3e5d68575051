// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QAction>
#include <QByteArray>
#include <QList>
#include <QObject>

class QMainWindow;
class QToolButton;
class QWidget;

namespace transillum::viewer {

/// Shows some views on the whole screen and back; its action shows the view under the pointer, else
/// the one with the keyboard focus. Panels that change the scene have it beside them. The other
/// parts of the window are hidden; no view is reparented, because OpenGL views do not survive that
/// on all systems.
class FullScreen : public QObject {
  Q_OBJECT

 public:
  explicit FullScreen(QMainWindow& window);

  QAction* action() const { return action_; }
  /// @param views docks of the window, or its central widget
  void show_only(const QList<QWidget*>& views);
  void show_all();

 signals:
  /// Emitted before views are hidden, and after all are shown again.
  void beginning();
  void ended();
  /// The user has ended it by the action.
  void left();

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void toggle();
  void place_way_out();
  QWidget* view_of(QWidget* widget) const;

  QMainWindow& window_;
  QAction* action_;
  QToolButton* leave_;  ///< the visible way out
  bool covers_title_ = false;
  bool active_ = false;
  Qt::WindowStates states_before_;
  QByteArray state_;
  QList<QWidget*> hidden_;  ///< widgets other than docks and tool bars
};

}  // namespace transillum::viewer
