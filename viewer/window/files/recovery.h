// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLockFile>
#include <QObject>
#include <QString>
#include <QTimer>

#include "window/base/window_parts.h"

namespace transillum::viewer {

class WindowSession;

/// Keeps the session of the window in a file while the program runs: every minute, and soon after
/// each iteration; the solve in a checkpoint beside it (SolveRunner::save_to()). If the program is
/// killed, the next one offers to go on from there. A solve without a checkpoint is made again;
/// either way it ends with the bits of the unbroken one.
///
/// Threads: the main thread only. Several programs may use one folder.
class Recovery : public QObject {
  Q_OBJECT

 public:
  /// What the arguments refer to must outlive this object.
  /// @param folder where the sessions are kept; created if it is missing
  Recovery(const WindowFrame& frame, WindowSession& session, const QString& folder);
  /// The program ends as it should: removes the session that it kept.
  ~Recovery() override;

  static QString usual_folder();
  /// Shows a bar that offers to go on from a session whose program no longer runs, if there is one.
  void offer();
  /// Keeps the session now. Does nothing without a scene, or where the file cannot be written.
  void keep();

 private:
  QString session_file(const QString& name) const;
  /// Makes a checkpoint of another program this one's; empty if there is none.
  QString taken_over(const QString& checkpoint) const;
  /// Removes solves whose sessions are gone.
  void remove_orphans() const;
  void on_snapshot();
  void restore();
  void discard();

  WindowFrame frame_;
  WindowSession& session_;
  QString folder_, name_;
  QLockFile lock_;   ///< held while the program runs
  QString offered_;  ///< file of the session that is offered; empty: none
  QTimer every_, soon_;
  int kept_iteration_ = -1;
};

}  // namespace transillum::viewer
