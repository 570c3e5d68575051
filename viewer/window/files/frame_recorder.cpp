// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Recording. Pictures of a film wait in a short queue for the worker, which compresses them; Play
// and FilmWalk wait for the queue. Where a solve is faster than the worker, the picture that is
// shown when there is room is taken.
#include "window/files/frame_recorder.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QPainter>
#include <QResizeEvent>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "film/film_file.h"
#include "map/map_canvas.h"
#include "map/map_view.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "stepping/play_control.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "widgets/theme.h"
#include "window/base/notifier.h"
#include "window/files/film_dialog.h"
#include "window/files/whole_file.h"

namespace transillum::viewer {

namespace {

constexpr std::size_t most_waiting = 8;  ///< pictures, some MB each

/// Number of the last frame of an earlier recording, which is continued; 0 where there is none.
int last_frame_in(const QString& folder) {
  int last = 0;
  for (const QString& name : QDir(folder).entryList({QStringLiteral("frame_*.png")})) {
    last = std::max(last, name.mid(6, name.size() - 10).toInt());
  }
  return last;
}

/// Writes a text on a dark plate in the lower left corner.
void write_caption(QImage& picture, const QString& text) {
  QPainter painter(&picture);
  QFont font = painter.font();
  font.setPixelSize(std::max(11, picture.height() / 28));
  painter.setFont(font);
  const int space = font.pixelSize() / 2;
  QRect plate = painter.fontMetrics().boundingRect(text).adjusted(-space, 0, space, 0);
  plate.moveBottomLeft(picture.rect().bottomLeft() + QPoint(space, -space));
  painter.fillRect(plate, theme::scene_background.lighter(140));
  painter.setPen(theme::on_dark);
  painter.drawText(plate, Qt::AlignCenter, text);
}

}  // namespace

FrameRecorder::FrameRecorder(const WindowFrame& frame, PlayControl& play, MapView& map)
    : QObject(&frame.window),
      frame_(frame),
      play_(play),
      map_(map),
      worker_([this](const FilmRequest& film,
                     const Cancellation& cancellation) { write_waiting(film, cancellation); },
              [this](const FilmRequest& film, const QString& message) { report(film, message); }) {
  const auto add = [this](const char* name, const QString& text, const QString& tip) {
    auto* action = make_action(this, name, text, tip);
    action->setCheckable(true);
    return action;
  };
  frames_action_ = add("export_frames", tr("Record frames…"),
                       tr("Write each new picture of the scene as a PNG, during the solve and at "
                          "each step, until switched off"));
  film_action_ = add("save_film", tr("Save film…"),
                     tr("Write a film of scene, map or both, as WebM, MP4 or GIF (Shift+L)"));
  film_action_->setShortcut(QKeySequence(QStringLiteral("Shift+L")));
  connect(frames_action_, &QAction::triggered, this, &FrameRecorder::choose_folder);
  connect(film_action_, &QAction::triggered, this, &FrameRecorder::choose_film);
  make_mark();
  play_.set_gate([this] { return has_room(); });
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, [this] { record(); });
  // While the newest direction is followed, snapshots are already recorded.
  connect(&frame_.state.focus, &Focus::moved, this, [this] {
    if (!frame_.state.focus.following()) {
      record();
    }
    walk_soon();
  });
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, [this] {
    if (walk_ && frame_.state.scene.loaded() != film_->loaded) {
      lose(tr("Another scene was opened"));
    }
    show_state();
  });
  show_state();
}

FrameRecorder::~FrameRecorder() {
  frame_.state.focus.disconnect(this);
  worker_.clear();
}

// Over the corner of the window: a projector shows no status bar.
void FrameRecorder::make_mark() {
  mark_ = named("recording", new QWidget(&frame_.window));
  mark_->setAutoFillBackground(true);
  mark_text_ = named("recording_text", new QLabel);
  finish_ = named("finish_recording", new QToolButton,
                  tr("Write the film with the pictures so far (Shift+L)"));
  finish_->setText(tr("Finish"));
  auto* discard = named("cancel_recording", new QToolButton, tr("Discard the film"));
  discard->setText(tr("Cancel"));
  auto* row = make_row(mark_, {8, 2, 4, 2});
  row->addWidget(mark_text_);
  row->addWidget(finish_);
  row->addWidget(discard);
  frame_.window.installEventFilter(this);
  connect(finish_, &QToolButton::clicked, this, &FrameRecorder::end);
  connect(discard, &QToolButton::clicked, this, &FrameRecorder::cancel);
}

void FrameRecorder::place_mark() {
  mark_->adjustSize();
  mark_->move(frame_.window.width() - mark_->width() - 4, 2);
  mark_->raise();
}

bool FrameRecorder::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && film_) {
    place_mark();
  }
  return QObject::eventFilter(watched, event);
}

void FrameRecorder::add_to(QMenu& menu) const { menu.addAction(frames_action_); }

void FrameRecorder::choose_folder() {
  if (!folder_.isEmpty()) {
    end();
    return;
  }
  const QString folder =
      QFileDialog::getExistingDirectory(&frame_.window, tr("Folder for the frames"));
  if (folder.isEmpty()) {
    show_state();
  } else {
    begin_frames(folder);
  }
}

void FrameRecorder::choose_film() {
  if (film_) {
    end();
    return;
  }
  show_state();  // not yet checked
  const QWidget* canvas = frame_.page.scene_view()->canvas();
  plan_.size = FilmFile::even(canvas->size() * canvas->devicePixelRatioF());
  std::vector<FilmPlan::Over> missing;
  for (const auto& [over, change] : changes_) {
    if (!change->can_film()) {
      missing.push_back(over);
    }
  }
  FilmDialog dialog(plan_, frame_.state.focus.map() != nullptr, missing, &frame_.window);
  if (dialog.exec() != QDialog::Accepted) {
    return;
  }
  const QString scene =
      QString::fromStdString(frame_.state.scene.snapshot()->loaded->scene->name());
  const QString path =
      ask_where_to_write(&frame_.window, tr("Save film"), tr("Films (*.webm *.mp4 *.gif)"),
                         QFileInfo(scene).completeBaseName() + QStringLiteral(".webm"));
  if (!path.isEmpty()) {
    begin_film(path, dialog.plan());
  }
}

void FrameRecorder::begin_frames(const QString& folder) {
  end();
  folder_ = folder;
  frames_ = last_frame_in(folder);
  record();
  show_state();
}

void FrameRecorder::set_change(FilmPlan::Over over, FilmedChange& change) {
  changes_[over] = &change;
  connect(&change, &FilmedChange::lit, this, &FrameRecorder::walk_soon);
  connect(&change, &FilmedChange::film_lost, this, &FrameRecorder::lose);
}

void FrameRecorder::begin_film(const QString& path, const FilmPlan& plan) {
  cancel();
  const auto found = changes_.find(plan.over);
  FilmedChange* change = found == changes_.end() ? nullptr : found->second;
  if (change && !change->can_film()) {
    lose(tr("This change cannot be filmed now"));
    return;
  }
  folder_.clear();
  frames_ = 0;
  ended_ = missed_ = false;
  plan_ = plan;
  film_ = std::make_shared<Film>();
  film_->path = path;
  film_->plan = plan;
  film_->loaded = frame_.state.scene.loaded();
  if (plan.over == FilmPlan::Over::changes) {
    record();
  } else {
    play_.stop();
    walk_.emplace(plan, frame_.state.focus, *frame_.page.scene_view(), change);
    walk_soon();
  }
  show_state();
}

void FrameRecorder::end() {
  folder_.clear();
  if (film_ && !ended_) {
    ended_ = true;  // before the walk goes back
    walk_.reset();
    {
      const std::lock_guard lock(film_->mutex);
      film_->ended = true;
    }
    worker_.request(film_, CurrentJob::finish);
  }
  show_state();
}

void FrameRecorder::cancel() {
  worker_.clear();
  film_ = nullptr;
  walk_.reset();
  show_state();
}

void FrameRecorder::lose(const QString& why) {
  cancel();
  frame_.notifier.show_failure(tr("%1: no film was written").arg(why));
}

bool FrameRecorder::has_room() const {
  if (!film_ || ended_) {
    return true;
  }
  const std::lock_guard lock(film_->mutex);
  return film_->waiting.size() < most_waiting;
}

void FrameRecorder::record() {
  if (!folder_.isEmpty()) {
    record_file();
  } else if (film_ && !ended_ && film_->plan.over == FilmPlan::Over::changes) {
    missed_ = !has_room();
    if (!missed_) {
      record_picture();
    }
  }
}

void FrameRecorder::on_written() {
  if (missed_) {
    record();
  }
  walk_soon();
  show_state();
}

void FrameRecorder::record_file() {
  try {
    const QString name = QStringLiteral("frame_%1.png").arg(frames_ + 1, 5, 10, QLatin1Char('0'));
    write_png(QDir(folder_).filePath(name), frame_.page.scene_view()->picture(1));
    ++frames_;
  } catch (const std::exception& error) {
    end();
    frame_.notifier.show_failure(QString::fromStdString(error.what()));
  }
}

void FrameRecorder::walk_soon() {
  if (walk_ && !walks_soon_) {
    walks_soon_ = true;
    QMetaObject::invokeMethod(this, &FrameRecorder::walk_on, Qt::QueuedConnection);
  }
}

// Called after each move of the focus and whenever the queue has room, until there is no more.
void FrameRecorder::walk_on() {
  walks_soon_ = false;
  if (!walk_ || !has_room() || !walk_->arrived()) {
    return;
  }
  record_picture();
  if (walk_->next()) {
    walk_soon();
  } else {
    end();
  }
}

QImage FrameRecorder::picture() const {
  const FilmPlan& plan = film_->plan;
  SceneView& scene = *frame_.page.scene_view();
  if (plan.show == FilmPlan::Show::scene) {
    return scene.picture({.size = plan.size});
  }
  if (plan.show == FilmPlan::Show::map) {
    return map_.picture(plan.size);
  }
  constexpr int gap = 2;
  const QSize half((plan.size.width() - gap) / 2, plan.size.height());
  QImage both(plan.size, QImage::Format_RGB32);
  both.fill(Qt::black);
  QPainter painter(&both);
  painter.drawImage(0, 0, scene.picture({.size = half}));
  painter.drawImage(half.width() + gap, 0, map_.picture(half));
  return both;
}

void FrameRecorder::record_picture() {
  QImage picture = this->picture();
  if (picture.isNull()) {
    return;
  }
  if (walk_ && !walk_->caption().isEmpty()) {
    write_caption(picture, walk_->caption());
  }
  ++frames_;
  {
    const std::lock_guard lock(film_->mutex);
    film_->waiting.push_back(std::move(picture));
  }
  worker_.request(film_, CurrentJob::finish);
  show_state();
}

// Runs on the worker's thread. A request that was replaced by another has been served by it.
void FrameRecorder::write_waiting(const FilmRequest& film, const Cancellation& cancellation) {
  while (true) {
    QImage picture;
    {
      const std::lock_guard lock(film->mutex);
      if (!film->waiting.empty()) {
        picture = std::move(film->waiting.front());
        film->waiting.pop_front();
      } else if (!film->ended) {
        return;
      }
    }
    cancellation.throw_if_canceled();
    if (picture.isNull()) {
      break;
    }
    if (!film->file) {
      film->file = std::make_unique<FilmFile>(film->path, film->plan.size, film->plan.per_second);
    }
    film->file->add(picture, cancellation);
    QMetaObject::invokeMethod(this, &FrameRecorder::on_written, Qt::QueuedConnection);
  }
  if (std::exchange(film->finished, true)) {
    return;
  }
  if (film->file) {
    film->file->finish();
  }
  report(film, film->file ? QString() : tr("There is no picture to write"));
}

// On the worker's thread.
void FrameRecorder::report(const FilmRequest& film, const QString& failure) {
  QMetaObject::invokeMethod(
      this,
      [this, film, failure] {
        if (film != film_) {
          return;  // canceled meanwhile
        }
        cancel();
        if (failure.isEmpty()) {
          frame_.notifier.show_written(film->path);
        } else {
          frame_.notifier.show_failure(failure);
        }
      },
      Qt::QueuedConnection);
}

void FrameRecorder::show_state() {
  const bool any = frame_.state.scene.snapshot() != nullptr;
  for (QAction* action : {frames_action_, film_action_}) {
    enable_if(*action, any, tr("No scene is solved yet"));
  }
  frames_action_->setChecked(!folder_.isEmpty());
  film_action_->setChecked(film_ && !ended_);
  mark_->setVisible(film_ != nullptr);
  if (!film_) {
    return;
  }
  std::size_t waiting = 0;
  {
    const std::lock_guard lock(film_->mutex);
    waiting = film_->waiting.size();
  }
  enable_if(*finish_, !ended_, tr("The film is being written"));
  const QString text =
      ended_
          ? tr("Writing: %1 of %2 pictures").arg(frames_ - static_cast<int>(waiting)).arg(frames_)
      : walk_ ? tr("Recording: %1 of %2").arg(frames_).arg(walk_->count())
              : tr("Recording: %1").arg(frames_);
  mark_text_->setText(QStringLiteral("<span style='color:#e5484d'>●</span> ") + text);
  place_mark();
}

}  // namespace transillum::viewer
