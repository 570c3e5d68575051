// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QLockFile>
#include <QObject>
#include <QString>
#include <QTimer>
#include <memory>
#include <string>

#include "window/base/window_views.h"

namespace transillum::viewer {

class WindowSession;
struct Session;

/// Keeps the session of the window in a file while the program runs: every minute, and soon after
/// each iteration. The solve is in a checkpoint beside it (SolveRunner::save_to()). If the program
/// is killed, the next one offers to continue from there. A solve without a checkpoint is repeated;
/// in both cases the result has the bits of an uninterrupted solve. Edited faces that the user has
/// not saved are in an OBJ file beside the session. The files of a session that is continued stay
/// until its scene is open and kept again.
///
/// Threads: the main thread only. Several programs may use one folder.
class Recovery : public QObject {
  Q_OBJECT

 public:
  /// The objects that the arguments refer to must outlive this object.
  /// @param folder where the sessions are kept; created if it is missing
  Recovery(const WindowFrame& frame, WindowSession& session, const QString& folder);
  /// The program ends as it should: removes the session that it kept, unless leave_faces() was
  /// called before.
  ~Recovery() override;

  static QString usual_folder();
  /// Shows a bar that offers to continue a session whose program no longer runs, if there is one.
  void offer();
  /// Keeps the session now. Does nothing without a scene, or where the file cannot be written.
  void keep() { try_keep(); }
  /// To be called when the program must end without a question: where faces are not saved, keeps
  /// the session, and leaves it to the next program.
  void leave_faces();

 private:
  QString session_file(const QString& name) const;
  /// The OBJ file of the faces that were kept as number `generation`.
  QString faces_file(int generation) const;
  /// keep(). @returns whether the session was kept
  bool try_keep();
  /// Takes over a checkpoint of another program. @returns its new path, empty if there is none
  QString taken_over(const QString& checkpoint) const;
  /// Writes the edited faces that the user has not saved, to a new file. If that fails, earlier
  /// ones of the same scene stay.
  void keep_faces();
  /// Removes solves and faces whose sessions are gone.
  void remove_orphans() const;
  void on_snapshot();
  void restore();
  /// Reads the offered session and gives its faces to the scene. @throws InputError
  Session read_offered();
  /// Ends restore() once the scene is open.
  void finish_if_open();
  /// Ends restore() without success: the session can be offered again.
  void give_back();
  /// give_back(), then offer(); nothing without a restore() that has not ended.
  void offer_again();
  void discard();

  WindowFrame frame_;
  WindowSession& session_;
  QString folder_, name_;
  QLockFile lock_;   ///< held while the program runs
  QString offered_;  ///< file of the session that is offered; may be empty
  /// Held from restore() until the session is open or given back; null at other times.
  std::unique_ptr<QLockFile> restoring_;
  QString taken_;               ///< taken_over(), for restoring_
  std::string restored_scene_;  ///< the scene of that session
  std::shared_ptr<const SceneDescription> restored_faces_;
  bool loads_ = false;                                  ///< a scene
  std::shared_ptr<const SceneDescription> kept_faces_;  ///< in faces_file(); null without one
  std::string kept_scene_;                              ///< whose faces they are
  int generation_ = 0;
  bool leaves_ = false;  ///< the kept session, to the next program
  QTimer every_, soon_;
  int kept_iteration_ = -1;
};

}  // namespace transillum::viewer
