// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Recording of the scene. Pictures of an animation wait in a short queue for the worker, which
// reduces their colors and compresses them; Play waits for the queue. Where a solve is faster than
// the worker, the picture that is shown when there is room is taken.
#include "window/files/frame_recorder.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QStatusBar>
#include <QToolButton>
#include <algorithm>
#include <utility>

#include "scene/gif_file.h"
#include "scene/scene_page.h"
#include "scene/scene_view.h"
#include "stepping/play_control.h"
#include "widgets/build.h"
#include "widgets/dialogs.h"
#include "window/base/notifier.h"
#include "window/files/export_actions.h"

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

}  // namespace

FrameRecorder::FrameRecorder(const WindowFrame& frame, PlayControl& play)
    : QObject(&frame.window),
      frame_(frame),
      play_(play),
      worker_([this](const AnimationRequest& animation,
                     const Cancellation& cancellation) { write_waiting(animation, cancellation); },
              [this](const AnimationRequest& animation, const QString& message) {
                report(animation, message);
              }) {
  const auto add = [this](const char* name, const QString& text, const QString& tip) {
    auto* action = make_action(this, name, text, tip);
    action->setCheckable(true);
    return action;
  };
  frames_action_ = add("export_frames", tr("Record frames…"),
                       tr("Write each new picture of the scene as a PNG, during the solve and at "
                          "each step, until switched off"));
  animation_action_ = add("export_animation", tr("Record an animation…"),
                          tr("Write each new picture of the scene to an animated GIF, at the speed "
                             "of Play, until switched off (Shift+L)"));
  animation_action_->setShortcut(QKeySequence(QStringLiteral("Shift+L")));
  connect(frames_action_, &QAction::triggered, this, &FrameRecorder::choose_folder);
  connect(animation_action_, &QAction::triggered, this, &FrameRecorder::choose_animation);
  add_status(frame);
  play_.set_gate([this] { return has_room(); });
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, [this] { record(); });
  // While the newest direction is followed, snapshots are already recorded.
  connect(&frame_.state.focus, &Focus::moved, this, [this] {
    if (!frame_.state.focus.following()) {
      record();
    }
  });
  connect(&frame_.state.scene, &OpenScene::snapshot_shown, this, &FrameRecorder::show_state);
  show_state();
}

FrameRecorder::~FrameRecorder() { worker_.clear(); }

void FrameRecorder::add_status(const WindowFrame& frame) {
  status_ = named("recording", new QWidget);
  status_text_ = new QLabel;
  finish_ = named("finish_recording", new QToolButton,
                  tr("Write the animation with the pictures so far (Shift+L)"));
  finish_->setText(tr("Finish"));
  auto* discard = named("cancel_recording", new QToolButton, tr("Discard the animation"));
  discard->setText(tr("Cancel"));
  auto* row = make_row(status_, {0, 0, 6, 0});
  row->addWidget(status_text_);
  row->addWidget(finish_);
  row->addWidget(discard);
  frame.window.statusBar()->addPermanentWidget(status_);
  connect(finish_, &QToolButton::clicked, this, &FrameRecorder::end);
  connect(discard, &QToolButton::clicked, this, &FrameRecorder::cancel);
}

void FrameRecorder::add_to(QMenu& menu) const {
  menu.addActions({frames_action_, animation_action_});
}

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

void FrameRecorder::choose_animation() {
  if (animation_) {
    end();
    return;
  }
  const QString scene =
      QString::fromStdString(frame_.state.scene.snapshot()->loaded->scene->name());
  const QString path =
      ask_where_to_write(&frame_.window, tr("Animation"), tr("Animations (*.gif)"),
                         QFileInfo(scene).completeBaseName() + QStringLiteral(".gif"));
  if (path.isEmpty()) {
    show_state();
  } else {
    begin_animation(path);
  }
}

void FrameRecorder::begin_frames(const QString& folder) {
  end();
  folder_ = folder;
  frames_ = last_frame_in(folder);
  record();
  show_state();
}

void FrameRecorder::begin_animation(const QString& path) {
  cancel();
  folder_.clear();
  frames_ = 0;
  ended_ = missed_ = false;
  animation_ = std::make_shared<Animation>();
  animation_->path = path;
  animation_->delay_ms = qRound(1000 / play_.speed());
  record();
  show_state();
}

void FrameRecorder::end() {
  folder_.clear();
  if (animation_ && !ended_) {
    ended_ = true;
    {
      const std::lock_guard lock(animation_->mutex);
      animation_->ended = true;
    }
    worker_.request(animation_, CurrentJob::finish);
  }
  show_state();
}

void FrameRecorder::cancel() {
  worker_.clear();
  animation_ = nullptr;
  show_state();
}

bool FrameRecorder::has_room() const {
  if (!animation_ || ended_) {
    return true;
  }
  const std::lock_guard lock(animation_->mutex);
  return animation_->waiting.size() < most_waiting;
}

void FrameRecorder::record() {
  if (!folder_.isEmpty()) {
    record_file();
  } else if (animation_ && !ended_) {
    missed_ = !has_room();
    if (!missed_) {
      record_animated();
    }
  }
}

void FrameRecorder::on_written() {
  if (missed_) {
    record();
  }
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

void FrameRecorder::record_animated() {
  QImage picture = frame_.page.scene_view()->picture(1);
  if (picture.isNull()) {
    return;
  }
  ++frames_;
  {
    const std::lock_guard lock(animation_->mutex);
    animation_->waiting.push_back(std::move(picture));
  }
  worker_.request(animation_, CurrentJob::finish);
  show_state();
}

// Runs on the worker's thread. A request that was replaced by another has been served by it.
void FrameRecorder::write_waiting(const AnimationRequest& animation,
                                  const Cancellation& cancellation) {
  while (true) {
    QImage picture;
    {
      const std::lock_guard lock(animation->mutex);
      if (!animation->waiting.empty()) {
        picture = std::move(animation->waiting.front());
        animation->waiting.pop_front();
      } else if (!animation->ended) {
        return;
      }
    }
    cancellation.throw_if_canceled();
    if (picture.isNull()) {
      break;
    }
    if (!animation->file) {
      animation->file =
          std::make_unique<GifFile>(animation->path, picture.size(), animation->delay_ms);
    }
    animation->file->add(picture, cancellation);
    QMetaObject::invokeMethod(this, &FrameRecorder::on_written, Qt::QueuedConnection);
  }
  if (animation->file) {
    animation->file->finish();
    report(animation, {});
  }
}

// On the worker's thread.
void FrameRecorder::report(const AnimationRequest& animation, const QString& failure) {
  QMetaObject::invokeMethod(
      this,
      [this, animation, failure] {
        if (animation != animation_) {
          return;  // canceled meanwhile
        }
        cancel();
        if (failure.isEmpty()) {
          frame_.notifier.show_written(animation->path);
        } else {
          frame_.notifier.show_failure(failure);
        }
      },
      Qt::QueuedConnection);
}

void FrameRecorder::show_state() {
  const bool any = frame_.state.scene.snapshot() != nullptr;
  frames_action_->setEnabled(any);
  animation_action_->setEnabled(any);
  frames_action_->setChecked(!folder_.isEmpty());
  animation_action_->setChecked(animation_ && !ended_);
  status_->setVisible(animation_ != nullptr);
  if (!animation_) {
    return;
  }
  std::size_t waiting = 0;
  {
    const std::lock_guard lock(animation_->mutex);
    waiting = animation_->waiting.size();
  }
  finish_->setEnabled(!ended_);
  status_text_->setText(ended_ ? tr("Writing the animation: %1 of %2 pictures")
                                     .arg(frames_ - static_cast<int>(waiting))
                                     .arg(frames_)
                               : tr("Recording: %1 pictures").arg(frames_));
}

}  // namespace transillum::viewer
