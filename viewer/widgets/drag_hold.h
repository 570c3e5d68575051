// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QEvent>
#include <QKeyEvent>
#include <QObject>
#include <functional>
#include <utility>

namespace transillum::viewer {

/// Tells which changes of widgets belong to one drag, one press or one key, however often it
/// repeats.
class DragHold : public QObject {
 public:
  /// @param began  called before the first change of each
  explicit DragHold(std::function<void()> began) : began_(std::move(began)) {}

  void watch(QObject* widget) { widget->installEventFilter(this); }
  /// To be called before each change of a watched widget.
  void change() {
    if (!held_ || !changed_) {
      began_();
    }
    changed_ = true;
  }

 protected:
  bool eventFilter(QObject*, QEvent* event) override {
    const QEvent::Type type = event->type();
    const bool is_key = type == QEvent::KeyPress || type == QEvent::KeyRelease;
    if (is_key && static_cast<QKeyEvent*>(event)->isAutoRepeat()) {
      return false;
    }
    if (type == QEvent::MouseButtonPress || type == QEvent::KeyPress) {
      held_ = true;
      changed_ = false;
    } else if (type == QEvent::MouseButtonRelease || type == QEvent::KeyRelease ||
               type == QEvent::FocusOut) {
      held_ = false;
    }
    return false;
  }

 private:
  std::function<void()> began_;
  bool held_ = false;     ///< a mouse button or a key is down
  bool changed_ = false;  ///< since the press
};

}  // namespace transillum::viewer
