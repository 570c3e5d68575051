// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QApplication>
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

}  // namespace transillum::viewer
