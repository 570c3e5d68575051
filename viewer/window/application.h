// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What the program does with exceptions and signals.
#pragma once

#include <QApplication>
#include <QObject>
#include <functional>

#include "support/failure_text.h"

namespace transillum::viewer {

/// Reports exceptions that nothing else catches, such as std::bad_alloc in an event handler or an
/// action, as messages. Without it, they would leave Qt's event loop, which must not happen.
class Application : public QApplication {
 public:
  using QApplication::QApplication;

  /// Called with a message for the user. If it is not set, exceptions are not caught.
  std::function<void(const QString& message)> on_failure;

  bool notify(QObject* receiver, QEvent* event) override {
    try {
      return QApplication::notify(receiver, event);
    } catch (...) {
      if (!on_failure) {
        throw;
      }
      on_failure(current_failure_text());
      return true;
    }
  }
};

/// Reports SIGINT, SIGTERM and SIGHUP in the event loop instead of ending the process at once.
/// Signals that were ignored when the program started stay ignored. The second signal of a kind
/// ends the process.
///
/// Threads: the main thread only. At most one object at a time.
class EndingSignals : public QObject {
  Q_OBJECT

 public:
  /// @throws std::system_error
  explicit EndingSignals(QObject* parent = nullptr);
  ~EndingSignals() override;

  /// The first signal received, or 0.
  int number() const { return number_; }

 signals:
  /// Emitted once, on the first signal.
  void received(int number);

 private:
  void read();

  int number_ = 0;
};

}  // namespace transillum::viewer
