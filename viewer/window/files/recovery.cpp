// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Each running program has a file of its session, NAME.json, a file of its solve, NAME.tck, and a
// lock file, NAME.lock, which tells other programs whether it still runs. Edited faces are in
// NAME.obj and NAME.mtl.
#include "window/files/recovery.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QMainWindow>
#include <QPushButton>
#include <QStandardPaths>
#include <QUuid>
#include <filesystem>
#include <utility>

#include "base/json_text.h"
#include "lessons/session_file.h"
#include "scene/scene_page.h"
#include "support/failure_text.h"
#include "transillum/files.h"
#include "transillum/scene.h"
#include "widgets/banner.h"
#include "window/base/notifier.h"
#include "window/base/open_scene.h"
#include "window/files/window_session.h"

namespace transillum::viewer {

namespace {

constexpr int every_ms = 60'000, soon_ms = 1'000;

QString made(const QString& folder) {
  QDir().mkpath(folder);
  return folder;
}

/// A file beside the file of a session.
QString beside(const QString& session, const char* ending) {
  return session.chopped(QStringLiteral("json").size()) + ending;
}
QString checkpoint_of(const QString& session) { return beside(session, "tck"); }
QString faces_of(const QString& session) { return beside(session, "obj"); }

void remove_faces(const QString& session) {
  QFile::remove(faces_of(session));
  QFile::remove(beside(session, "mtl"));
}

}  // namespace

Recovery::Recovery(const WindowFrame& frame, WindowSession& session, const QString& folder)
    : QObject(&frame.window),
      frame_(frame),
      session_(session),
      folder_(made(folder)),
      name_(QUuid::createUuid().toString(QUuid::WithoutBraces)),
      lock_(folder_ + '/' + name_ + ".lock") {
  lock_.setStaleLockTime(0);  // a program may run for days
  lock_.tryLock();
  every_.setInterval(every_ms);
  soon_.setInterval(soon_ms);
  soon_.setSingleShot(true);
  connect(&every_, &QTimer::timeout, this, &Recovery::keep);
  connect(&soon_, &QTimer::timeout, this, &Recovery::keep);
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, &Recovery::on_snapshot);
  for (const auto signal : {&OpenScene::scene_loaded, &OpenScene::patches_changed}) {
    connect(&frame_.state.scene, signal, this, [this] { kept_iteration_ = -1; });
  }
  every_.start();
  frame_.state.runner.save_to(checkpoint_of(session_file(name_)).toStdString());
  Banner* bar = frame_.page.recovery_bar();
  QPushButton* restore = bar->add_button("restore_session", tr("Continue"));
  restore->setToolTip(
      tr("Open the saved session, with its scene, solve, position, views and notes"));
  connect(restore, &QPushButton::clicked, this, &Recovery::restore);
  QPushButton* discard = bar->add_button("discard_session", tr("Discard"));
  discard->setToolTip(tr("Delete the saved session"));
  connect(discard, &QPushButton::clicked, this, [this] {
    this->discard();
    offer();
  });
}

Recovery::~Recovery() {
  QFile::remove(session_file(name_));
  remove_faces(session_file(name_));
  frame_.state.runner.save_to({});
}

QString Recovery::usual_folder() {
  return QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) +
         QStringLiteral("/kept-sessions");
}

QString Recovery::session_file(const QString& name) const {
  return QStringLiteral("%1/%2.json").arg(folder_, name);
}

QString Recovery::taken_over(const QString& checkpoint) const {
  const QString mine = QStringLiteral("%1/%2-taken.tck").arg(folder_, name_);
  return QFile::rename(checkpoint, mine) ? mine : QString();
}

void Recovery::remove_orphans() const {
  for (const QFileInfo& found :
       QDir(folder_).entryInfoList({"*.tck", "*.obj", "*.mtl"}, QDir::Files)) {
    const QString name = found.completeBaseName().remove(QStringLiteral("-taken"));
    QLockFile lock(folder_ + '/' + name + ".lock");
    lock.setStaleLockTime(0);
    if (name != name_ && !QFile::exists(session_file(name)) && lock.tryLock()) {
      QFile::remove(found.filePath());
    }
  }
}

void Recovery::on_snapshot() {
  const int iteration = frame_.state.scene.snapshot()->progress.iteration;
  if (iteration != kept_iteration_ && !soon_.isActive()) {
    kept_iteration_ = iteration;
    soon_.start();
  }
}

void Recovery::keep_faces() {
  const OpenScene& scene = frame_.state.scene;
  const auto faces = scene.has_unsaved_faces() ? scene.faces().edited : nullptr;
  if (faces && faces != kept_faces_) {
    write_obj(faces_of(session_file(name_)).toStdString(), *faces);
  } else if (!faces && kept_faces_) {
    remove_faces(session_file(name_));
  }
  kept_faces_ = faces;
}

void Recovery::keep() {
  if (!frame_.state.scene.loaded()) {
    return;
  }
  try {
    keep_faces();
    const std::string text = to_text(session_.current(), folder_.toStdString());
    write_file_whole(session_file(name_).toStdString(), [&](std::ostream& out) { out << text; });
  } catch (const std::exception&) {
    // A full disk must not interrupt the user every minute.
  }
}

void Recovery::offer() {
  remove_orphans();
  // The newest session comes first; others are offered once it is discarded, or by later starts.
  for (const QFileInfo& found : QDir(folder_).entryInfoList({"*.json"}, QDir::Files, QDir::Time)) {
    QLockFile lock(folder_ + '/' + found.completeBaseName() + ".lock");
    lock.setStaleLockTime(0);
    if (found.completeBaseName() == name_ || !lock.tryLock()) {
      continue;  // its program runs
    }
    offered_ = found.filePath();
    frame_.page.recovery_bar()->show_message(
        Banner::Kind::offer,
        tr("The program ended unexpectedly. Its session of %1 was saved.")
            .arg(found.lastModified().toString(QStringLiteral("yyyy-MM-dd hh:mm"))));
    return;
  }
}

void Recovery::restore() {
  if (!frame_.guard.may_lose(&frame_.window, tr("Continue"), WorkGuard::Lost::scene)) {
    return;
  }
  frame_.page.recovery_bar()->dismiss();
  frame_.state.runner.resume_from(taken_over(checkpoint_of(offered_)).toStdString());
  try {
    const std::string name = offered_.toStdString();
    const Session session = session_from_text(read_json_file(name), name, folder_.toStdString());
    if (const QString file = faces_of(offered_); QFile::exists(file)) {
      SceneDescription faces = describe_scene(file.toStdString());
      faces.name = std::filesystem::path(session.state.scene).filename().string();
      faces.files.clear();
      frame_.state.scene.give_faces(session.state.scene,
                                    std::make_shared<const SceneDescription>(std::move(faces)));
    }
    session_.restore(session);
  } catch (const std::exception& error) {
    frame_.notifier.show_failure(failure_text(error));
    return;
  }
  discard();
}

void Recovery::discard() {
  frame_.page.recovery_bar()->dismiss();
  QFile::remove(checkpoint_of(offered_));
  remove_faces(offered_);
  QFile::remove(offered_);
  offered_.clear();
}

}  // namespace transillum::viewer
