// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QProcess>
#include <QTemporaryDir>

namespace transillum::viewer::test {

/// Openbox on the display of the tests, while this object exists: a window manager that frames and
/// places windows and gives them the focus, as on a desktop.
class WindowManager {
 public:
  /// Waits until it has begun. @param program  path of openbox
  explicit WindowManager(const QString& program);
  ~WindowManager();

  /// Whether it runs.
  bool runs() const { return runs_; }

 private:
  QTemporaryDir folder_;  ///< its cache and settings, and the file that says that it has begun
  QProcess process_;
  bool runs_ = false;
};

}  // namespace transillum::viewer::test
