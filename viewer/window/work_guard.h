// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

class QWidget;

namespace transillum::viewer {

class OpenScene;

/// Asks before a solve that took long is discarded.
class WorkGuard {
 public:
  /// @param scene must outlive this object
  explicit WorkGuard(const OpenScene& scene) : scene_(scene) {}

  /// Whether the solve of the open scene may be discarded: it took less than a minute, or the user
  /// agrees.
  /// @param what  text of the button, such as "Quit"
  bool may_lose(QWidget* parent, const QString& what) const;
  /// For tests: the time from which a solve took long.
  void set_long_seconds(double seconds) { long_seconds_ = seconds; }

 private:
  const OpenScene& scene_;
  double long_seconds_ = 60;
};

}  // namespace transillum::viewer
