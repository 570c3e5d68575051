// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "relighter.h"

#include <QMetaObject>
#include <utility>

#include "thread_priority.h"

namespace transillum::viewer {

Relighter::Relighter(QObject* parent) : QObject(parent), worker_([this] { work(); }) {}

Relighter::~Relighter() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    cancellation_.cancel();
  }
  wake_.notify_one();
  worker_.join();
}

void Relighter::request(Request request) {
  {
    // What is under way goes on: while a slider is drawn, a late picture is better than none.
    const std::lock_guard lock(mutex_);
    request_ = std::move(request);
    request_number_ = ++asked_;
  }
  wake_.notify_one();
}

void Relighter::clear() {
  const std::lock_guard lock(mutex_);
  request_.reset();
  cancellation_.cancel();
  delivered_ = asked_;
}

void Relighter::work() {
  give_way_to_the_window();
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return quit_ || request_; });
    if (quit_) return;
    Request request = *std::exchange(request_, std::nullopt);
    const quint64 number = request_number_;
    cancellation_ = Cancellation();
    const Cancellation cancellation = cancellation_;
    lock.unlock();

    std::shared_ptr<const Relit> light;
    QString error;
    try {
      RelightOptions options;
      options.tolerance = request.tolerance;
      options.start = request.start;
      light = std::make_shared<const Relit>(
          relight(*request.scene, *request.form_factors, request.materials, options, cancellation));
    } catch (const Cancelled&) {
      // Nobody waits for it any more.
    } catch (const std::exception& failure) {
      error = QString::fromUtf8(failure.what());
    }
    QMetaObject::invokeMethod(
        this,
        [this, light, error, number, materials = std::move(request.materials)] {
          if (number <= delivered_) return;  // cleared since
          delivered_ = number;
          if (light) emit relit(light, materials);
          if (!error.isEmpty()) emit failed(error);
        },
        Qt::QueuedConnection);
    lock.lock();
  }
}

}  // namespace transillum::viewer
