// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "window/base/window_views.h"
#include "window/files/reading.h"

class QAction;
class QMenu;
class QSettings;

namespace transillum::viewer {

class ViewStateApplier;
class WindowSession;

/// Opens scenes, results, sessions and lessons, keeps the list of recent files, saves sessions, and
/// reads the scene's file again when it changes.
class FileActions : public QObject {
  Q_OBJECT

 public:
  /// The references must outlive this object.
  FileActions(const WindowFrame& frame, DockLayouts& docks, SettingsPanel& settings,
              LessonPanel& lessons, ViewStateApplier& applier, WindowSession& session);

  void add_to(QMenu& menu);
  QAction* open_action() const { return open_; }

  /// Opens a scene, a result, a session or a lesson, by its name and content.
  /// @param goal if it is not set, a scene is solved, and a result is only shown
  /// @param input how a scene is read; ignored for results, sessions and lessons. By default, the
  /// file is read as it was read before
  /// @param as_given whether the file is read by `input` even if that is the default
  /// @throws InputError where a session or lesson cannot be read; a scene that cannot be read is
  /// reported later by SolveRunner::failed
  void open(const QString& path, std::optional<Goal> goal = {}, const SceneInput& input = {},
            bool as_given = false);
  /// open() for files that the user has chosen or dropped: errors go to the banner.
  void try_open(const QString& path);
  /// Opens a file or a built-in scene with the default camera and exposure and without anything
  /// that a lesson has set, and follows the newest direction. Asks before long work is lost, like
  /// the other functions.
  void open_scene(const QString& spec, Goal goal = {Goal::Kind::finished},
                  const SceneInput& input = {}, bool as_given = false);
  /// Sets whether scenes of few faces are divided when they are opened, with linear functions
  /// (first_look.h), unless the settings have a limit of patches.
  void set_divides(bool divides) { divides_ = divides; }
  /// Shows a page of a lesson.
  /// @param which a file, or the number of a built-in lesson, from 1
  /// @param page from 1
  /// @throws InputError
  void open_lesson(const std::string& which, int page = 1);
  /// Asks for a lesson's file, and shows its first page.
  void choose_lesson();
  /// @throws InputError
  void open_session(const QString& path);
  /// Writes the session, whole or not at all. @throws std::runtime_error
  void save_session(const QString& path) const;
  /// Saves the session in the user's folder for data of the program, when the user cannot be asked
  /// for a file.
  /// @returns the path, which is also a recent file  @throws std::runtime_error
  QString save_unasked();

  const QStringList& recent() const { return recent_; }
  /// How scene files were read before. open() and open_scene() read a file so again, except where
  /// they get other options.
  ReadingMemory& reading() { return reading_memory_; }
  void save(QSettings& settings) const;
  void load(const QSettings& settings);

  /// Asks where, and saves the session there.
  void choose_session();
  /// @param saved  asks to save edited faces before a session; returns whether it can name them
  void set_saver(std::function<bool()> saved) { saved_ = std::move(saved); }

 private:
  void choose_lobes(const QString& spec, SolveOptions& solve);
  bool choose_basis(Basis basis);
  void leave_scene(const QString& next);
  void load_scene(const QString& spec, Goal goal, const SceneInput& input, bool as_given);
  void make_actions();
  void make_reading_bar();
  void make_division_bar();
  void show_first_look();
  /// Reads the scene again, with one patch per face.
  void keep_faces();
  /// Asks how the open scene's file is read, and reads it so.
  void choose_reading();
  void read_again(const SceneInput& input);
  void show_reading();
  void choose();
  void remember(const QString& path);
  void fill_recent();
  void on_scene_shown();
  void enable_for_scene(bool any);
  void watch_scene();
  void reload_if_written();

  std::function<bool()> saved_ = [] { return true; };
  WindowFrame frame_;
  DockLayouts& docks_;
  SettingsPanel& settings_;
  LessonPanel& lessons_;
  ViewStateApplier& applier_;
  WindowSession& session_;
  QAction *open_, *save_session_, *reload_, *watch_, *reading_;
  ReadingMemory reading_memory_;
  bool divides_ = true;            ///< set_divides()
  bool basis_is_of_look_ = false;  ///< linear functions were set for the open scene alone
  QString recalled_;               ///< the file that is opened as it was read before; may be empty
  QMenu* recent_menu_;
  QStringList recent_;
  QFileSystemWatcher watcher_;
  QTimer settle_;  ///< waits until the file has been written completely
  int checks_ = 0;
};

}  // namespace transillum::viewer
