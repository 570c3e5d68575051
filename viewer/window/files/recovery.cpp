// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Each running program has a file of its session, NAME.json, a file of its solve, NAME.tck, and a
// lock file, NAME.lock, which tells other programs whether it still runs. Edited faces are in
// NAME.N.obj and NAME.N.mtl, where N counts the edits; the session says which belong to it.
#include "window/files/recovery.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QMainWindow>
#include <QPushButton>
#include <QStandardPaths>
#include <QUuid>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json_text.h"
#include "lessons/session_file.h"
#include "scene/scene_page.h"
#include "support/failure_text.h"
#include "support/json_object.h"
#include "transillum/files.h"
#include "transillum/scene.h"
#include "widgets/banner.h"
#include "window/base/notifier.h"
#include "window/base/open_scene.h"
#include "window/files/kept_faces.h"
#include "window/files/window_session.h"

namespace transillum::viewer {

using nlohmann::json;

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

/// Removes all files of faces of a session but one OBJ with its MTL.
void remove_faces(const QString& session, const QString& but = {}) {
  const QFileInfo file(session);
  const QString any = file.completeBaseName() + ".*";
  for (const QFileInfo& found : file.dir().entryInfoList({any + "obj", any + "mtl"}, QDir::Files)) {
    if (but.isEmpty() || found.completeBaseName() != QFileInfo(but).completeBaseName()) {
      QFile::remove(found.filePath());
    }
  }
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
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, &Recovery::finish_if_open);
  connect(&frame_.state.runner, &SolveRunner::failed, this, &Recovery::offer_again);
  connect(&frame_.state.runner, &SolveRunner::state_changed, this, [this](RunState state) {
    if (std::exchange(loads_, state == RunState::loading) && !loads_) {
      offer_again();  // the load was canceled
    }
  });
  every_.start();
  frame_.state.runner.save_to(beside(session_file(name_), "tck").toStdString());
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
  give_back();
  if (leaves_) {
    return;
  }
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

QString Recovery::faces_file(int generation) const {
  return QStringLiteral("%1/%2.%3.obj").arg(folder_, name_).arg(generation);
}

QString Recovery::taken_over(const QString& checkpoint) const {
  const QString mine = QStringLiteral("%1/%2-taken.tck").arg(folder_, name_);
  return QFile::rename(checkpoint, mine) ? mine : QString();
}

void Recovery::remove_orphans() const {
  for (const QFileInfo& found :
       QDir(folder_).entryInfoList({"*.tck", "*.obj", "*.mtl"}, QDir::Files)) {
    const QString name = found.baseName().remove(QStringLiteral("-taken"));
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
  if (faces == kept_faces_) {
    return;
  }
  if (!faces || kept_scene_ != scene.spec()) {
    kept_faces_ = nullptr;
  }
  if (faces) {
    write_kept_faces(faces_file(generation_ + 1).toStdString(), *faces);
    ++generation_;
    kept_scene_ = scene.spec();
    kept_faces_ = faces;
  }
}

bool Recovery::try_keep() {
  if (!frame_.state.scene.loaded()) {
    return false;
  }
  bool faces_kept = true;
  try {
    keep_faces();
  } catch (const std::exception&) {
    faces_kept = false;
  }
  try {
    std::string text = to_text(session_.current(), folder_.toStdString());
    const QString file = kept_faces_ ? faces_file(generation_) : QString();
    if (kept_faces_) {
      json session = json::parse(text);
      session["faces"] = kept_lists(*kept_faces_);
      session["faces"]["file"] = QFileInfo(file).fileName().toStdString();
      text = session.dump(1, ' ', false, json::error_handler_t::replace) + '\n';
    }
    write_file_whole(session_file(name_).toStdString(), [&](std::ostream& out) { out << text; });
    remove_faces(session_file(name_), file);
    return faces_kept;
  } catch (const std::exception&) {
    return false;  // a full disk must not interrupt the user every minute
  }
}

void Recovery::leave_faces() { leaves_ = frame_.state.scene.has_unsaved_faces() && try_keep(); }

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
  auto lock = std::make_unique<QLockFile>(beside(offered_, "lock"));
  lock->setStaleLockTime(0);
  lock->tryLock();
  try {
    const Session session = read_offered();
    frame_.page.recovery_bar()->dismiss();
    restored_scene_ = session.state.scene;
    restoring_ = std::move(lock);
    loads_ = frame_.state.runner.state() == RunState::loading;
    taken_ = taken_over(beside(offered_, "tck"));
    frame_.state.runner.resume_from(taken_.toStdString());
    frame_.state.scene.give_faces(restored_scene_, restored_faces_);
    session_.restore(session);
  } catch (const std::exception& error) {
    frame_.notifier.show_failure(failure_text(error));
    offer_again();
    return;
  }
  if (!frame_.state.scene.is_opening()) {
    finish_if_open();
  }
}

Session Recovery::read_offered() {
  const std::string name = offered_.toStdString();
  json whole = parse_json(read_json_file(name), name);
  restored_faces_ = nullptr;
  if (whole.is_object() && whole.contains("faces")) {
    const json faces = whole["faces"];
    const std::string where = name + ", faces";
    std::string file;
    JsonObject(faces, where).read("file", file);
    const QString in_folder = QFileInfo(QString::fromStdString(file)).fileName();
    restored_faces_ = std::make_shared<const SceneDescription>(
        read_kept_faces((folder_ + '/' + in_folder).toStdString(), faces, where));
    whole.erase("faces");
  }
  return session_from_text(whole.dump(), name, folder_.toStdString());
}

void Recovery::finish_if_open() {
  if (!restoring_) {
    return;
  }
  const OpenScene& scene = frame_.state.scene;
  const bool open = restored_scene_.empty() || scene.spec() == restored_scene_;
  const bool has_faces = !restored_faces_ || scene.faces().edited == restored_faces_;
  if (!open || !has_faces) {
    offer_again();
    return;
  }
  restoring_.reset();
  restored_faces_ = nullptr;
  if (try_keep()) {
    discard();
  }
}

void Recovery::give_back() {
  if (!restoring_) {
    return;
  }
  frame_.state.scene.give_faces({}, nullptr);
  frame_.state.runner.resume_from({});
  if (!taken_.isEmpty()) {
    QFile::rename(taken_, beside(offered_, "tck"));
  }
  restored_faces_ = nullptr;
  restoring_.reset();
}

void Recovery::offer_again() {
  if (restoring_) {
    give_back();
    offer();
  }
}

void Recovery::discard() {
  frame_.page.recovery_bar()->dismiss();
  QFile::remove(beside(offered_, "tck"));
  remove_faces(offered_);
  QFile::remove(offered_);
  offered_.clear();
}

}  // namespace transillum::viewer
