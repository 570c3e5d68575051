// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/sharp_view.h"

#include <QAction>
#include <QEventLoop>
#include <QProgressDialog>
#include <utility>

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
          }) {
  action_ = make_key_action(this, "sharp", tr("Sharp"),
                            tr("Once the scene rests, compute its light in every pixel, with exact "
                               "shadows of lamps.\nIf this is off, the colors of the patches stay"),
                            QKeySequence(Qt::Key_S));
  action_->setCheckable(true);
  action_->setChecked(true);
  connect(action_, &QAction::changed, this, [this] {
    follow();
    view_.render();
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
  } else if (subject_ && !begun_) {
    rest_timer_->start();
  }
}

/// Compares what the view shows with what was requested; called before each picture is drawn.
void SharpView::follow() {
  std::optional<SharpSubject> now;
  if (action_->isEnabled() && action_->isChecked()) {
    now = view_.sharp_subject();
  }
  if (now == subject_) {
    return;
  }
  const bool same_light = now && subject_ && now->snapshot == subject_->snapshot;
  subject_ = std::move(now);
  stop();
  if (!same_light) {
    worker_.request({std::nullopt, number_});
  }
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
    emit progressed(0, true);  // make() gets none
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
  request(*subject_);
  show_progress({});
}

void SharpView::request(const SharpSubject& subject) {
  posted_ = false;
  worker_.request({subject, ++number_});
}

/// Runs on the worker's thread.
void SharpView::run(const Task& task, const Cancellation& cancellation) {
  if (!task.subject) {
    renderer_.release();
    return;
  }
  renderer_.render(
      *task.subject, cancellation, [&](const QImage& picture, const SharpProgress& progress) {
        if (posted_.exchange(true) && !progress.finished) {
          return;  // the window is still busy with an earlier one
        }
        const auto deliver = [this, number = task.number, copy = picture.copy(), progress] {
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
  }
  emit progressed(progress.fraction, progress.finished);
}

void SharpView::show_progress(const SharpProgress& progress) {
  label_->setVisible(!progress.finished);
  label_->setText(tr("sharp %1 %").arg(qRound(100 * progress.fraction)));
  label_->adjustSize();
  label_->move(label_distance, view_.canvas()->height() - label_->height() - label_distance);
}

std::optional<QImage> SharpView::make(int scale, QWidget* window) {
  follow();
  if (!wanted()) {
    return QImage();
  }
  if (scale == 1 && finished_) {
    return view_.sharp();
  }
  rest_timer_->stop();
  enlarges_ = true;
  enlarged_ = {};
  SharpSubject subject = *subject_;
  subject.size *= scale;
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
