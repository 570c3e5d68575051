// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/map_recorder.h"

#include <QMetaObject>
#include <chrono>
#include <utility>

namespace transillum::viewer {

namespace {

// Patient requests: at most two maps per second, and at most a quarter of one core.
constexpr Pause pause_between_maps{std::chrono::milliseconds(500), 3};

}  // namespace

MapRecorder::MapRecorder(QObject* parent)
    : QObject(parent),
      worker_(
          [this](const Task& task, const Cancellation& cancellation) { work(task, cancellation); },
          [this](const Task& task, const QString& message) {
            deliver(nullptr, message, task.number);
          },
          pause_between_maps) {}

void MapRecorder::request(Request request) {
  const Start start = request.patient ? Start::after_pause : Start::at_once;
  worker_.request({std::move(request), ++newest_}, CurrentJob::finish, start);
}

void MapRecorder::clear() {
  worker_.clear();
  delivered_ = newest_;
}

// On the worker's thread.
void MapRecorder::work(const Task& task, const Cancellation& cancellation) {
  const Request& request = task.request;
  auto map = std::make_shared<RecordedMap>();
  map->history = MapHistory(record_local_map(*request.loaded->scene, *request.loaded->tree,
                                             request.omega, cancellation, request.memory)
                                .record);
  map->loaded = request.loaded;
  map->iteration = request.iteration;
  map->direction = request.direction;
  map->passes = request.passes;
  deliver(map, {}, task.number);
}

// Runs on the worker's thread; what it posts runs on the owner's thread.
void MapRecorder::deliver(const std::shared_ptr<const RecordedMap>& map, const QString& error,
                          quint64 number) {
  const auto emit_result = [this, map, error, number] {
    if (number <= delivered_) {
      return;  // cleared since
    }
    delivered_ = number;
    if (map) {
      emit recorded(map);
    } else {
      emit failed(error);
    }
  };
  QMetaObject::invokeMethod(this, emit_result, Qt::QueuedConnection);
}

}  // namespace transillum::viewer
