// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QDockWidget>
#include <QWidget>

namespace transillum::viewer {

/// While it exists, nothing in a window is painted. Otherwise each panel that is moved would resize
/// the scene, which OpenGL widgets draw at once at each size.
class Unpainted {
 public:
  explicit Unpainted(QWidget& window) : window_(window), before_(window.updatesEnabled()) {
    window_.setUpdatesEnabled(false);
  }
  ~Unpainted() {
    window_.setUpdatesEnabled(before_);
    // Qt omits panels that have become windows of their own meanwhile.
    for (QDockWidget* panel : window_.findChildren<QDockWidget*>()) {
      if (before_ && panel->isWindow()) {
        panel->setUpdatesEnabled(true);
      }
    }
  }
  Unpainted(const Unpainted&) = delete;
  Unpainted& operator=(const Unpainted&) = delete;

 private:
  QWidget& window_;
  bool before_;
};

}  // namespace transillum::viewer
