// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/file_actions.h"

#include <QAction>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QSaveFile>
#include <QSettings>
#include <stdexcept>

#include "transillum/files.h"
#include "widgets/save_dialog.h"
#include "widgets/theme.h"
#include "window/main_window.h"
#include "window/view_state_applier.h"

namespace transillum::viewer {

namespace {

constexpr int most_recent = 10;
constexpr int settle_ms = 300, most_looks = 20;

QAction* make_action(QObject* parent, const char* name, const QString& text,
                     const QKeySequence& key, const QString& tip) {
  auto* action = new QAction(text, parent);
  action->setObjectName(QString::fromLatin1(name));
  action->setShortcut(key);
  action->setToolTip(tip);
  return action;
}

}  // namespace

FileActions::FileActions(MainWindow& window) : QObject(&window), window_(window) {
  open_ =
      make_action(this, "open", tr("Open…"), QKeySequence::Open,
                  tr("Open a scene, a result, a session or a lesson (Ctrl+O), or drop one here"));
  open_->setIcon(theme::icon(theme::Icon::open));
  save_session_ =
      make_action(this, "save_session", tr("Save session…"), QKeySequence::Save,
                  tr("Keep scene, options, focus, views, breakpoints and notes in a file"));
  reload_ = make_action(this, "reload", tr("Reload"), QKeySequence(QStringLiteral("Ctrl+R")),
                        tr("Read the scene's file again, and show the same of it"));
  watch_ = make_action(this, "watch", tr("Reload when the file changes"), {},
                       tr("Read the scene's file again whenever another program writes it"));
  watch_->setCheckable(true);
  recent_menu_ = new QMenu(tr("Open recent"), &window);
  settle_.setSingleShot(true);
  settle_.setInterval(settle_ms);

  connect(open_, &QAction::triggered, this, &FileActions::choose);
  connect(save_session_, &QAction::triggered, this, &FileActions::choose_session);
  connect(reload_, &QAction::triggered, this, &FileActions::reload);
  connect(watch_, &QAction::toggled, this, &FileActions::watch_scene);
  connect(recent_menu_, &QMenu::aboutToShow, this, &FileActions::fill_recent);
  connect(&watcher_, &QFileSystemWatcher::fileChanged, this, [this] {
    looks_ = 0;
    settle_.start();
  });
  connect(&settle_, &QTimer::timeout, this, &FileActions::look_at_file);
  connect(&window_, &MainWindow::scene_shown, this, [this] {
    const QString spec = QString::fromStdString(window_.spec());
    if (QFileInfo::exists(spec)) {
      remember(spec);
    }
    watch_scene();
    save_session_->setEnabled(true);
    reload_->setEnabled(true);
  });
  save_session_->setEnabled(false);
  reload_->setEnabled(false);
}

void FileActions::add_to(QMenu& menu) const {
  menu.addAction(open_);
  menu.addMenu(recent_menu_);
  for (QAction* action : {save_session_, reload_, watch_}) {
    menu.addAction(action);
  }
}

void FileActions::choose() {
  const QString path = QFileDialog::getOpenFileName(
      &window_, tr("Open"), {},
      tr("Scenes, results, sessions, lessons (*.obj *.vtp *.json);;Wavefront OBJ (*.obj);;Results "
         "(*.vtp);;Sessions and lessons (*.json);;All files (*)"));
  if (!path.isEmpty()) {
    try_open(path);
  }
}

void FileActions::try_open(const QString& path) {
  try {
    open(path);
  } catch (const std::exception& error) {
    window_.show_failure(QString::fromStdString(error.what()));
  }
}

void FileActions::open(const QString& path, std::optional<Goal> goal) {
  if (!path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive)) {
    const bool result = is_result_file(path.toStdString());
    window_.open_afresh(path, goal.value_or(result ? Goal{} : Goal{Goal::Kind::finished}));
    return;
  }
  const std::string name = path.toStdString();
  if (kind_of_json(text_of_file(name), name) == JsonFile::lesson) {
    window_.begin_lesson(name, 1);
  } else {
    open_session(path);
  }
  remember(path);
}

void FileActions::open_session(const QString& path) {
  const std::string name = path.toStdString();
  window_.show_session(
      session_from_text(text_of_file(name), name, QFileInfo(path).path().toStdString()));
}

void FileActions::choose_session() {
  const QString path = ask_where_to_write(&window_, tr("Save session"), tr("Sessions (*.json)"),
                                          QStringLiteral("session.json"));
  if (path.isEmpty()) {
    return;
  }
  try {
    save_session(path);
    remember(path);
    window_.say_written(path);
  } catch (const std::exception& error) {
    window_.show_failure(QString::fromStdString(error.what()));
  }
}

void FileActions::save_session(const QString& path) const {
  const std::string text =
      to_text(window_.current_session(), QFileInfo(path).absolutePath().toStdString());
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly) ||
      file.write(text.data(), static_cast<qint64>(text.size())) < 0 || !file.commit()) {
    throw std::runtime_error((path + ": " + file.errorString()).toStdString());
  }
  window_.keep_notes();
}

void FileActions::remember(const QString& path) {
  const QString full = QFileInfo(path).absoluteFilePath();
  recent_.removeAll(full);
  recent_.prepend(full);
  while (recent_.size() > most_recent) {
    recent_.removeLast();
  }
}

void FileActions::fill_recent() {
  recent_menu_->clear();
  for (const QString& path : recent_) {
    QAction* action =
        recent_menu_->addAction(QFileInfo(path).fileName(), this, [this, path] { try_open(path); });
    action->setToolTip(path);
    action->setEnabled(QFileInfo::exists(path));
  }
  if (recent_.isEmpty()) {
    recent_menu_->addAction(tr("Nothing yet"))->setEnabled(false);
  }
}

void FileActions::reload() { window_.stage().reload(); }

void FileActions::watch_scene() {
  if (!watcher_.files().isEmpty()) {
    watcher_.removePaths(watcher_.files());
  }
  if (!watch_->isChecked()) {
    return;
  }
  const QFileInfo scene(QString::fromStdString(window_.spec()));
  const QString materials = scene.path() + '/' + scene.completeBaseName() + ".mtl";
  for (const QString& path : {scene.filePath(), materials}) {
    if (QFileInfo::exists(path)) {
      watcher_.addPath(path);
    }
  }
}

void FileActions::look_at_file() {
  const QFileInfo scene(QString::fromStdString(window_.spec()));
  // Programs that write beside and rename leave no file for a moment.
  if (!scene.exists() || scene.size() == 0) {
    if (++looks_ < most_looks) {
      settle_.start();
    }
    return;
  }
  watch_scene();
  reload();
}

void FileActions::save(QSettings& settings) const { settings.setValue("files/recent", recent_); }

void FileActions::load(const QSettings& settings) {
  recent_ = settings.value("files/recent").toStringList().mid(0, most_recent);
}

}  // namespace transillum::viewer
