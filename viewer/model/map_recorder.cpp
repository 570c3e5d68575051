// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/map_recorder.h"

#include <QMetaObject>
#include <algorithm>
#include <chrono>
#include <utility>

#include "support/thread_priority.h"

namespace transillum::viewer {

MapRecorder::MapRecorder(QObject* parent) : QObject(parent), worker_([this] { work(); }) {}

MapRecorder::~MapRecorder() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    cancellation_.cancel();
  }
  wake_.notify_one();
  worker_.join();
}

void MapRecorder::request(Request request) {
  {
    const std::lock_guard lock(mutex_);
    request_ = std::move(request);
    request_number_ = ++asked_;
  }
  wake_.notify_one();
}

void MapRecorder::clear() {
  const std::lock_guard lock(mutex_);
  request_.reset();
  cancellation_.cancel();
  delivered_ = asked_;
}

void MapRecorder::work() {
  using Clock = std::chrono::steady_clock;
  give_way_to_the_window();
  Clock::time_point earliest = Clock::now();
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return quit_ || request_; });
    // Wait out the pause between two maps; a newer request may replace this one meanwhile.
    wake_.wait_until(lock, earliest, [this] { return quit_ || (request_ && !request_->patient); });
    if (quit_) {
      return;
    }
    if (!request_) {
      continue;
    }
    const Request request = *std::exchange(request_, std::nullopt);
    const quint64 number = request_number_;
    cancellation_ = Cancellation();
    const Cancellation cancellation = cancellation_;
    lock.unlock();

    const Clock::time_point begin = Clock::now();
    auto map = std::make_shared<RecordedMap>();
    QString error;
    try {
      map->history = MapHistory(record_local_map(*request.loaded->scene, *request.loaded->tree,
                                                 request.omega, cancellation)
                                    .record);
      map->loaded = request.loaded;
      map->iteration = request.iteration;
      map->direction = request.direction;
      map->passes = request.passes;
    } catch (const Canceled&) {
      map = nullptr;
    } catch (const std::exception& failure) {
      map = nullptr;
      error = QString::fromUtf8(failure.what());
    }
    // Patient ones: at most two maps a second, and at most a quarter of one core.
    const Clock::duration cost = Clock::now() - begin;
    earliest = Clock::now() + std::max<Clock::duration>(std::chrono::milliseconds(500), 3 * cost);
    QMetaObject::invokeMethod(
        this, [this, map, error, number] { deliver(map, error, number); }, Qt::QueuedConnection);
    lock.lock();
  }
}

void MapRecorder::deliver(const std::shared_ptr<const RecordedMap>& map, const QString& error,
                          quint64 number) {
  if (number <= delivered_) {
    return;  // cleared since
  }
  delivered_ = number;
  if (map) {
    emit recorded(map);
  }
  if (!error.isEmpty()) {
    emit failed(error);
  }
}

}  // namespace transillum::viewer
