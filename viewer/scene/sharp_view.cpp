// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/sharp_view.h"

#include <QAction>
#include <QEventLoop>
#include <QProgressDialog>
#include <utility>

#include "pictures/inside_solid.h"
#include "scene/scene_view.h"
#include "widgets/build.h"

namespace transillum::viewer {

namespace {

constexpr int pause_ms = 400;  // from the last change on
constexpr int label_distance = 10;

}  // namespace

SharpView::SharpView(SceneView& view, QObject* parent)
    : QObject(parent),
      view_(view),
      worker_(
          [this](const Task& task, const Cancellation& cancellation) { run(task, cancellation); },
          [this](const Task& task, const QString& message) {
            const auto report = [this, number = task.number, message] {
              if (number == number_) {
                finished_ = true;
                label_->hide();
                emit failed(message);
                emit progressed(1, true);
              }
            };
            QMetaObject::invokeMethod(this, report, Qt::QueuedConnection);
          }),
      map_worker_(
          [this](const std::shared_ptr<const SolverSnapshot>& snapshot,
                 const Cancellation& cancellation) {
            make_map(*renderer_.light_of(snapshot, cancellation), cancellation,
                     [this](const SurfaceMap& map) {
                       const auto deliver = [this, map] { receive_map(map); };
                       QMetaObject::invokeMethod(this, deliver, Qt::QueuedConnection);
                     });
          },
          [this](const std::shared_ptr<const SolverSnapshot>& snapshot, const QString& message) {
            const auto report = [this, snapshot, message] {
              if (snapshot == map_requested_) {
                map_finished_ = true;
                tell(message);
              }
            };
            QMetaObject::invokeMethod(this, report, Qt::QueuedConnection);
          }) {
  action_ = make_key_action(
      this, "sharp", tr("Sharp"),
      tr("Once the scene rests, compute its light in every pixel, with exact "
         "shadows of lamps.\nPatches keep their colors if this is off, and while their "
         "outlines, a step, or anything but light in true color is shown"),
      QKeySequence(Qt::Key_S));
  usual_tip_ = action_->toolTip();
  action_->setCheckable(true);
  action_->setChecked(true);
  on_ = true;
  connect(action_, &QAction::changed, this, [this] {
    const bool on = action_->isEnabled() && action_->isChecked();
    if (on != on_) {
      on_ = on;
      follow();
      view_.render();
    }
  });
  label_ = named("sharp_label", new Plate(view_.canvas()));
  rest_timer_ = new QTimer(this);
  rest_timer_->setSingleShot(true);
  rest_timer_->setInterval(pause_ms);
  connect(rest_timer_, &QTimer::timeout, this, &SharpView::start);
  connect(&view_, &SceneView::about_to_draw, this, &SharpView::follow);
}

void SharpView::set_solving(bool solving) {
  solving_ = solving;
  if (solving) {
    stop();
    if (!map_finished_) {
      release_map();
    }
  } else if (subject_ && !begun_) {
    rest_timer_->start();
  }
}

bool SharpView::settled() const { return view_.drawn() && (!wanted() || finished_); }

/// Compares what the view shows with what was requested; called before each picture is drawn.
void SharpView::follow() {
  std::optional<SharpSubject> now;
  if (on_) {
    now = view_.sharp_subject();
  }
  if (now == subject_) {
    return;
  }
  const bool same_light = now && subject_ && now->snapshot == subject_->snapshot;
  const bool moved_on = begun_ && same_light;
  const bool changed = now.has_value() != subject_.has_value();
  subject_ = std::move(now);
  if (changed) {
    emit wanted_changed(subject_.has_value());
  }
  stop();
  if (!same_light) {
    worker_.request({std::nullopt, number_});
  }
  if (map_requested_ && subject_ && subject_->snapshot != map_requested_) {
    release_map();
  }
  if (moved_on) {
    request_map();
  }
  view_.show_map(subject_ ? map_ : SurfaceMap());
  if (wanted()) {
    rest_timer_->start();
  }
}

/// Hides the picture, and cancels the one that is being made.
void SharpView::stop() {
  ++number_;
  worker_.clear();
  rest_timer_->stop();
  begun_ = finished_ = false;
  label_->hide();
  view_.set_sharp({});
  if (enlarges_) {
    emit failed(tr("The scene, its light or its view has changed: the picture was not made"));
    emit progressed(0, true);
  }
}

void SharpView::start() {
  if (!wanted()) {
    return;
  }
  if (view_.pressed()) {
    rest_timer_->start();
    return;
  }
  begun_ = true;
  is_inside_ = subject_->hidden.empty() && !subject_->half &&
               is_inside_solid(*subject_->loaded->picker, subject_->view.eye);
  request(*subject_);
  show_progress({});
}

void SharpView::request(const SharpSubject& subject) {
  posted_ = false;
  worker_.request({subject, ++number_, map_.light != nullptr});
}

/// Runs on the worker's thread.
void SharpView::run(const Task& task, const Cancellation& cancellation) {
  if (!task.subject) {
    renderer_.release();
    return;
  }
  renderer_.render(*task.subject, task.begins_fine, cancellation,
                   [&](const QImage& picture, const SharpProgress& progress) {
                     if (posted_.exchange(true) && !progress.finished) {
                       return;  // the window is still busy with an earlier one
                     }
                     const auto deliver = [this, number = task.number, copy = picture.copy(),
                                           progress] {
                       posted_ = false;
                       if (number == number_) {
                         receive(copy, progress);
                       }
                     };
                     QMetaObject::invokeMethod(this, deliver, Qt::QueuedConnection);
                   });
}

void SharpView::receive(const QImage& picture, const SharpProgress& progress) {
  if (enlarges_) {
    if (progress.finished) {
      enlarged_ = picture;
    }
  } else {
    finished_ = progress.finished;
    view_.set_sharp(picture);
    show_progress(progress);
    view_.render();
    if (progress.fraction >= 1.0 / SharpRenderer::samples) {
      request_map();  // every pixel is known; more samples only make edges smooth
    }
  }
  emit progressed(progress.fraction, progress.finished);
}

void SharpView::show_progress(const SharpProgress& progress) {
  label_->setVisible(!progress.finished || is_inside_);
  label_->setText(progress.finished ? tr("The eye is inside a solid: backs are not drawn")
                                    : tr("sharp %1 %").arg(qRound(100 * progress.fraction)));
  label_->adjustSize();
  label_->move(label_distance, view_.canvas()->height() - label_->height() - label_distance);
}

/// Once for each snapshot.
void SharpView::request_map() {
  if (!wanted() || map_requested_ == subject_->snapshot) {
    return;
  }
  map_requested_ = subject_->snapshot;
  const QString reason = why_no_map(*map_requested_);
  tell(reason);
  map_finished_ = !reason.isEmpty();
  if (!map_finished_) {
    map_worker_.request(map_requested_);
  }
}

void SharpView::release_map() {
  map_worker_.clear();
  map_requested_ = nullptr;
  map_ = {};
  map_finished_ = false;
  view_.show_map({});
}

void SharpView::receive_map(const SurfaceMap& map) {
  if (map.snapshot != map_requested_) {
    return;
  }
  map_finished_ = map_.light != nullptr;  // the first is coarse
  map_ = map;
  if (subject_) {
    view_.show_map(map_);
    view_.render();
  }
}

/// Says in the tool tip why something is not shown.
void SharpView::tell(const QString& reason) {
  action_->setToolTip(reason.isEmpty() ? usual_tip_ : usual_tip_ + '\n' + reason);
}

std::optional<QImage> SharpView::make(const QSize& size, QWidget* window) {
  follow();
  if (!wanted()) {
    return QImage();
  }
  if (size == subject_->size && finished_) {
    return view_.sharp();
  }
  rest_timer_->stop();
  enlarges_ = true;
  enlarged_ = {};
  SharpSubject subject = *subject_;
  const auto aspect_of = [](const QSize& of) { return 1.0 * of.width() / of.height(); };
  subject.view = widened(subject.view, aspect_of(subject.size), aspect_of(size));
  subject.size = size;
  request(subject);
  constexpr int whole = 1000;
  QProgressDialog dialog(tr("Making the sharp picture…"), tr("Cancel"), 0, whole, window);
  dialog.setObjectName("sharp_dialog");
  dialog.setWindowModality(Qt::WindowModal);
  QEventLoop loop;
  const auto follow_progress =
      connect(this, &SharpView::progressed, &dialog, [&](double fraction, bool finished) {
        dialog.setValue(qRound(0.999 * whole * fraction));
        if (finished) {
          loop.quit();
        }
      });
  connect(&dialog, &QProgressDialog::canceled, &loop, &QEventLoop::quit);
  loop.exec();
  disconnect(follow_progress);
  enlarges_ = false;
  ++number_;
  worker_.clear();
  if (!finished_ && wanted()) {
    rest_timer_->start();
  }
  return enlarged_.isNull() ? std::nullopt : std::optional(std::exchange(enlarged_, QImage()));
}

}  // namespace transillum::viewer
