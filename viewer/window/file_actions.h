// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <optional>

#include "lessons/session_file.h"

class QAction;
class QMenu;
class QSettings;

namespace transillum::viewer {

class MainWindow;

/// The files of the window: scenes, sessions and lessons opened, lately opened, saved, read again.
class FileActions : public QObject {
  Q_OBJECT

 public:
  explicit FileActions(MainWindow& window);

  void add_to(QMenu& menu) const;
  QAction* open_action() const { return open_; }

  /// A scene, a result, a session or a lesson, by its name and content.
  /// @param goal none: a scene is solved, a result just shown.
  /// @throws InputError where a session or lesson cannot be read; a scene that cannot be read is
  /// told later, by MainWindow::failed.
  void open(const QString& path, std::optional<Goal> goal = {});
  /// open() for files the user has just chosen or dropped: what is wrong goes to the banner.
  void try_open(const QString& path);
  /// @throws InputError
  void open_session(const QString& path);
  /// Written whole or not at all. @throws std::runtime_error
  void save_session(const QString& path) const;

  const QStringList& recent() const { return recent_; }
  void save(QSettings& settings) const;
  void load(const QSettings& settings);

  /// Asks where, and saves the session there.
  void choose_session();

 private:
  void choose();
  void remember(const QString& path);
  void fill_recent();
  void reload();
  void watch_scene();
  void look_at_file();

  MainWindow& window_;
  QAction *open_, *save_session_, *reload_, *watch_;
  QMenu* recent_menu_;
  QStringList recent_;
  QFileSystemWatcher watcher_;
  QTimer settle_;  ///< a file is written in several strokes
  int looks_ = 0;
};

}  // namespace transillum::viewer
