// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLockFile>
#include <QObject>
#include <QString>
#include <QTimer>

#include "window/base/window_views.h"

namespace transillum::viewer {

class WindowSession;

/// Keeps the session of the window in a file while the program runs: every minute, and soon after
/// each iteration. The solve is in a checkpoint beside it (SolveRunner::save_to()). If the program
/// is killed, the next one offers to continue from there. A solve without a checkpoint is repeated;
/// in both cases the result has the bits of an uninterrupted solve. Edited faces that no file of
/// the user has are in an OBJ file beside the session.
///
/// Threads: the main thread only. Several programs may use one folder.
class Recovery : public QObject {
  Q_OBJECT

 public:
  /// The objects that the arguments refer to must outlive this object.
  /// @param folder where the sessions are kept; created if it is missing
  Recovery(const WindowFrame& frame, WindowSession& session, const QString& folder);
  /// The program ends as it should: removes the session that it kept.
  ~Recovery() override;

  static QString usual_folder();
  /// Shows a bar that offers to continue a session whose program no longer runs, if there is one.
  void offer();
  /// Keeps the session now. Does nothing without a scene, or where the file cannot be written.
  void keep();

 private:
  QString session_file(const QString& name) const;
  /// Takes over a checkpoint of another program. @returns its new path, empty if there is none
  QString taken_over(const QString& checkpoint) const;
  /// Writes the edited faces that no file has; removes the file where there are none.
  void keep_faces();
  /// Removes solves and faces whose sessions are gone.
  void remove_orphans() const;
  void on_snapshot();
  void restore();
  void discard();

  WindowFrame frame_;
  WindowSession& session_;
  QString folder_, name_;
  QLockFile lock_;   ///< held while the program runs
  QString offered_;  ///< file of the session that is offered; may be empty
  std::shared_ptr<const SceneDescription> kept_faces_;  ///< in the file; null without one
  QTimer every_, soon_;
  int kept_iteration_ = -1;
};

}  // namespace transillum::viewer
