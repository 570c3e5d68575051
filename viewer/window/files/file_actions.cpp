// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/file_actions.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <QPushButton>
#include <QSaveFile>
#include <QSettings>
#include <QStandardPaths>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/json_text.h"
#include "lessons/lesson_panel.h"
#include "lessons/session_file.h"
#include "scene/scene_page.h"
#include "solve/settings_panel.h"
#include "support/failure_text.h"
#include "support/first_sentence.h"
#include "support/number_text.h"
#include "transillum/at.h"
#include "transillum/files.h"
#include "widgets/banner.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "widgets/theme.h"
#include "window/base/dock_layouts.h"
#include "window/base/notifier.h"
#include "window/base/open_scene.h"
#include "window/base/view_state_applier.h"
#include "window/files/first_look.h"
#include "window/files/reading.h"
#include "window/files/window_session.h"

namespace transillum::viewer {

namespace {

constexpr int most_recent = 10;
constexpr int settle_ms = 300, most_checks = 20;

}  // namespace

FileActions::FileActions(const WindowFrame& frame, DockLayouts& docks, SettingsPanel& settings,
                         LessonPanel& lessons, ViewStateApplier& applier, WindowSession& session)
    : QObject(&frame.window),
      frame_(frame),
      docks_(docks),
      settings_(settings),
      lessons_(lessons),
      applier_(applier),
      session_(session) {
  make_actions();
  make_reading_bar();
  make_division_bar();
  recent_menu_ = new QMenu(tr("Open recent"), &frame_.window);
  settle_.setSingleShot(true);
  settle_.setInterval(settle_ms);

  connect(open_, &QAction::triggered, this, &FileActions::choose);
  connect(save_session_, &QAction::triggered, this, &FileActions::choose_session);
  connect(reload_, &QAction::triggered, this, [this] {
    if (frame_.guard.may_lose(&frame_.window, tr("Reload"))) {
      frame_.state.scene.read_saved();
      applier_.reload();
    }
  });
  connect(watch_, &QAction::toggled, this, &FileActions::watch_scene);
  connect(recent_menu_, &QMenu::aboutToShow, this, &FileActions::fill_recent);
  connect(&watcher_, &QFileSystemWatcher::fileChanged, this, [this] {
    checks_ = 0;
    settle_.start();
  });
  connect(&settle_, &QTimer::timeout, this, &FileActions::reload_if_written);
  connect(&frame_.state.scene, &OpenScene::scene_shown, this, &FileActions::on_scene_shown);
  enable_for_scene(false);
}

void FileActions::make_actions() {
  open_ =
      make_action(this, "open", tr("Open…"),
                  tr("Open a scene, a result, a session or a lesson (Ctrl+O), or drop one here"),
                  QKeySequence::Open);
  open_->setIcon(theme::icon(theme::Icon::open));
  save_session_ =
      make_action(this, "save_session", tr("Save session…"),
                  tr("Save scene, options, focus, views, breakpoints and notes in a file (Ctrl+S)"),
                  QKeySequence::Save);
  reload_ = make_action(this, "reload", tr("Reload"),
                        tr("Read the scene's file again and keep the view (Ctrl+R)"),
                        QKeySequence("Ctrl+R"));
  watch_ = make_action(this, "watch", tr("Reload when the file changes"),
                       tr("Read the scene's file again whenever another program changes it"));
  watch_->setCheckable(true);
  reading_ = make_action(this, "reading", tr("Units and orientation…"),
                         tr("Read the scene's file in another unit, or with its faces turned or "
                            "joined; the choice is remembered for the file"));
  enable_if(*reading_, false, tr("No scene is open"));
  connect(reading_, &QAction::triggered, this, &FileActions::choose_reading);
}

void FileActions::make_reading_bar() {
  Banner* bar = frame_.page.reading_bar();
  QPushButton* change = bar->add_button("change_reading", tr("Change…"));
  QPushButton* usual = bar->add_button("usual_reading", tr("Read as usual"));
  usual->setToolTip(
      tr("Read the file in meters, with faces as in the file; forget the earlier choice"));
  connect(change, &QPushButton::clicked, this, &FileActions::choose_reading);
  connect(usual, &QPushButton::clicked, this, [this] {
    SceneInput input;
    input.changes = frame_.state.scene.input().changes;
    read_again(input);
  });
}

void FileActions::make_division_bar() {
  QPushButton* keep = frame_.page.division_bar()->add_button("keep_faces", tr("Keep my faces"));
  keep->setToolTip(tr("One patch per face of the file, with one value of B on each"));
  connect(keep, &QPushButton::clicked, this, &FileActions::keep_faces);
}

void FileActions::choose_reading() {
  if (frame_.state.scene.faces().edited) {
    frame_.notifier.show_failure(tr("Faces were edited: save the scene, and open it again."));
    return;
  }
  ReadingDialog dialog(QString::fromStdString(frame_.state.scene.spec()),
                       frame_.state.scene.input(), &frame_.window);
  if (dialog.exec() == QDialog::Accepted && !(dialog.input() == frame_.state.scene.input())) {
    read_again(dialog.input());
  }
}

void FileActions::read_again(const SceneInput& input) {
  if (frame_.guard.may_lose(&frame_.window, tr("Reload"))) {
    applier_.open_again({settings_.solve_options(), frame_.state.scene.options(), input});
  }
}

/// Shows how the file was read, if an earlier choice was applied, and remembers it for the next
/// time.
void FileActions::show_reading() {
  const QString path =
      QFileInfo(QString::fromStdString(frame_.state.scene.spec())).absoluteFilePath();
  const auto loaded = frame_.state.scene.loaded();
  const bool from_file = loaded->description && !loaded->description->files.empty();
  enable_if(*reading_, from_file, tr("The scene was not read from a scene file"));
  const QString text = ReadingMemory::text_of(frame_.state.scene.input());
  if (from_file && recalled_ == path && !text.isEmpty()) {
    frame_.page.reading_bar()->show_message(
        Banner::Kind::offer, tr("This file is read as chosen before: %1.").arg(text));
  } else {
    frame_.page.reading_bar()->dismiss();
  }
  recalled_.clear();
  if (from_file && !applier_.in_lesson()) {
    reading_memory_.remember(path, frame_.state.scene.input());
  }
}

void FileActions::on_scene_shown() {
  const QString spec = QString::fromStdString(frame_.state.scene.spec());
  if (QFileInfo::exists(spec)) {
    remember(spec);
    propose_folder(QFileInfo(spec).absolutePath());
  }
  show_reading();
  show_first_look();
  watch_scene();
  enable_for_scene(true);
}

void FileActions::enable_for_scene(bool any) {
  for (QAction* action : {save_session_, reload_}) {
    enable_if(*action, any, tr("No scene is open"));
  }
}

void FileActions::add_to(QMenu& menu) {
  QMenu* built_in = menu.addMenu(theme::icon(theme::Icon::scene), tr("Built-in scene"));
  for (const BuiltInScene& scene : built_in_scenes()) {
    const QString name = QString::fromStdString(scene.name);
    built_in->addAction(tr("%1 – %2").arg(name, first_sentence(scene.summary)), this,
                        [this, name] { open_scene(name); });
  }
  menu.addAction(open_);
  menu.addMenu(recent_menu_);
  menu.addActions({save_session_, reload_, watch_, reading_});
}

void FileActions::choose() {
  QStringList endings, formats;
  for (const SceneFormat& format : scene_formats()) {
    const QString pattern = "*" + QString::fromStdString(format.ending);
    endings += pattern;
    formats += QString("%1 (%2)").arg(QString::fromStdString(format.name), pattern);
  }
  const QString path = QFileDialog::getOpenFileName(
      &frame_.window, tr("Open"), {},
      tr("Scenes, results, sessions, lessons (%1 *.vtp *.json)").arg(endings.join(' ')) + ";;" +
          formats.join(";;") +
          tr(";;Results (*.vtp);;Sessions and lessons (*.json);;All files (*)"));
  if (!path.isEmpty()) {
    try_open(path);
  }
}

void FileActions::try_open(const QString& path) {
  try {
    open(path);
  } catch (const std::exception& error) {
    frame_.notifier.show_failure(failure_text(error));
  }
}

void FileActions::open(const QString& path, std::optional<Goal> goal, const SceneInput& input,
                       bool as_given) {
  if (!path.endsWith(QLatin1String(".json"), Qt::CaseInsensitive)) {
    const bool result = is_result_file(path.toStdString());
    open_scene(path, goal.value_or(result ? Goal{} : Goal{Goal::Kind::finished}), input, as_given);
    return;
  }
  const std::string name = path.toStdString();
  if (kind_of_json(read_json_file(name), name) == JsonFile::lesson) {
    open_lesson(name);
  } else {
    open_session(path);
  }
  remember(path);
}

void FileActions::open_scene(const QString& spec, Goal goal, const SceneInput& input,
                             bool as_given) {
  if (frame_.guard.may_lose(&frame_.window, tr("Open"), WorkGuard::Lost::scene)) {
    leave_scene(spec);
    load_scene(spec, goal, input, as_given);
  }
}

/// Resets the options that were set for the open scene alone.
/// @param next the scene that is opened instead
void FileActions::leave_scene(const QString& next) {
  applier_.leave_lesson();
  if (next.toStdString() != frame_.state.scene.spec() && std::exchange(basis_is_of_look_, false)) {
    choose_basis(Basis::constant);
  }
}

void FileActions::load_scene(const QString& spec, Goal goal, const SceneInput& input,
                             bool as_given) {
  RunOptions options = settings_.options();
  options.input = input;
  const QString path = QFileInfo(spec).absoluteFilePath();
  recalled_.clear();
  if (const auto before = reading_memory_.find(path);
      before && !as_given && ReadingMemory::reading_of(input) == SceneInput{} &&
      QFileInfo::exists(spec)) {
    options.input = *before;
    options.input.changes = input.changes;
    options.input.patches = input.patches;
    recalled_ = path;
  }
  if (spec.toStdString() != frame_.state.scene.spec()) {
    choose_lobes(spec, options.solve);
  }
  if (frame_.state.scene.loaded() && spec.toStdString() != frame_.state.scene.spec()) {
    options.scene = {};  // the options in the panel are of the open scene
    options.refine = {};
  }
  const bool is_new = spec.toStdString() != frame_.state.scene.spec();
  frame_.state.scene.open(spec.toStdString(), options, goal,
                          divides_ && is_new && has_first_look(spec.toStdString()));
}

/// Says that faces were divided unasked, and takes over the functions on patches that go with it.
void FileActions::show_first_look() {
  const auto loaded = frame_.state.scene.loaded();
  Banner& bar = *frame_.page.division_bar();
  if (loaded->divided_faces == 0) {
    bar.dismiss();
    return;
  }
  if (settings_.solve_options().basis == Basis::constant) {
    basis_is_of_look_ = choose_basis(Basis::linear);
  }
  if (loaded->description->files.empty()) {
    bar.dismiss();
    return;  // built-in scenes have no faces of the user's
  }
  const auto patches = static_cast<std::int64_t>(loaded->scene->patch_count());
  bar.show_message(
      Banner::Kind::offer,
      tr("%1 faces are divided into %2 patches, with linear functions.")
          .arg(count_text(static_cast<std::int64_t>(loaded->divided_faces)), count_text(patches)));
}

void FileActions::keep_faces() {
  if (!frame_.guard.may_lose(&frame_.window, tr("Keep my faces"))) {
    return;
  }
  basis_is_of_look_ = false;
  choose_basis(Basis::constant);
  RunOptions options = settings_.options();
  options.scene.max_patch_area = 0;
  options.input = frame_.state.scene.input();
  applier_.open_again(options);
}

/// @returns whether the other settings allow it
bool FileActions::choose_basis(Basis basis) {
  SolveOptions solve = settings_.solve_options();
  solve.basis = basis;
  try {
    solve.validate();
  } catch (const InputError&) {
    return false;
  }
  settings_.set_options(solve, settings_.scene_options());
  return true;
}

/// Lobes take part in the built-in scene that is about them, where the other settings allow it; in
/// other scenes only where the user asks for them.
void FileActions::choose_lobes(const QString& spec, SolveOptions& solve) {
  const bool has_lobes = spec.section(QLatin1Char(':'), 0, 0) == QLatin1String("gallery");
  if (!has_lobes && !frame_.state.scene.loaded()) {
    return;  // the command line decides
  }
  solve.glossy = has_lobes;
  try {
    solve.validate();
  } catch (const InputError&) {
    solve.glossy = false;
  }
  settings_.set_options(solve, settings_.scene_options());
  frame_.state.colors.show_lobes(solve.glossy);
}

QString FileActions::save_unasked() {
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  QDir().mkpath(folder);
  QString path = folder + QStringLiteral("/unsaved-session.json");
  save_session(path);
  remember(path);
  return path;
}

void FileActions::choose_lesson() {
  const QString path = QFileDialog::getOpenFileName(&frame_.window, tr("Open a lesson"), {},
                                                    tr("Lessons (*.json);;All files (*)"));
  if (path.isEmpty()) {
    return;
  }
  try {
    open_lesson(path.toStdString());
  } catch (const std::exception& error) {
    frame_.notifier.show_failure(failure_text(error));
  }
}

void FileActions::open_lesson(const std::string& which, int page) {
  bool is_number = false;
  int lesson = QString::fromStdString(which).toInt(&is_number) - 1;
  if (!is_number) {
    Lesson read = read_lesson(which);
    check_panels(read, which, docks_.panels());
    lessons_.add(std::move(read));
    lesson = 0;
  }
  const auto& lessons = lessons_.lessons();
  if (lesson < 0 || lesson >= std::ssize(lessons)) {
    throw InputError("there are lessons 1 to " + std::to_string(lessons.size()));
  }
  const auto& pages = at(lessons, lesson).pages;
  if (page < 1 || page > std::ssize(pages)) {
    throw InputError("the lesson has pages 1 to " + std::to_string(pages.size()));
  }
  frame_.notifier.dismiss();
  lessons_.show_page(lesson, page - 1);
}

void FileActions::open_session(const QString& path) {
  const std::string name = path.toStdString();
  const Session session =
      session_from_text(read_json_file(name), name, QFileInfo(path).path().toStdString());
  if (frame_.guard.may_lose(&frame_.window, tr("Open"), WorkGuard::Lost::scene)) {
    session_.restore(session);
  }
}

void FileActions::choose_session() {
  if (!saved_()) {
    return;
  }
  const QString path = ask_where_to_write(
      &frame_.window, tr("Save session"), tr("Sessions (*.json)"),
      QStringLiteral("session.transillum.json"), QStringLiteral("transillum.json"));
  if (path.isEmpty()) {
    return;
  }
  try {
    save_session(path);
    remember(path);
    frame_.notifier.show_written(path);
  } catch (const std::exception& error) {
    frame_.notifier.show_failure(failure_text(error));
  }
}

void FileActions::save_session(const QString& path) const {
  const std::string text =
      to_text(session_.current(), QFileInfo(path).absolutePath().toStdString());
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly) ||
      file.write(text.data(), static_cast<qint64>(text.size())) < 0 || !file.commit()) {
    throw std::runtime_error((path + ": " + file.errorString()).toStdString());
  }
  session_.set_notes_saved();
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
    enable_if(*action, QFileInfo::exists(path), tr("The file does not exist any more"));
  }
  if (recent_.isEmpty()) {
    recent_menu_->addAction(tr("No recent files"))->setEnabled(false);
  }
}

void FileActions::watch_scene() {
  if (!watcher_.files().isEmpty()) {
    watcher_.removePaths(watcher_.files());
  }
  if (!watch_->isChecked()) {
    return;
  }
  const QFileInfo scene(QString::fromStdString(frame_.state.scene.spec()));
  const QString materials = scene.path() + '/' + scene.completeBaseName() + ".mtl";
  for (const QString& path : {scene.filePath(), materials}) {
    if (QFileInfo::exists(path)) {
      watcher_.addPath(path);
    }
  }
}

void FileActions::reload_if_written() {
  const QFileInfo scene(QString::fromStdString(frame_.state.scene.spec()));
  // Programs that write a temporary file and rename it leave no file for a moment.
  if (!scene.exists() || scene.size() == 0) {
    if (++checks_ < most_checks) {
      settle_.start();
    }
    return;
  }
  watch_scene();
  frame_.state.scene.read_saved();
  applier_.reload();
}

void FileActions::save(QSettings& settings) const {
  settings.setValue("files/recent", recent_);
  reading_memory_.save(settings);
}

void FileActions::load(const QSettings& settings) {
  recent_ = settings.value("files/recent").toStringList().mid(0, most_recent);
  reading_memory_.load(settings);
}

}  // namespace transillum::viewer
