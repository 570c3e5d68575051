// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Computes what one patch sees along each direction, with the engine of the solve run, and delivers
// results in batches while it computes.
#include "model/requests/per_direction_visibility.h"

#include <QMetaObject>
#include <chrono>
#include <utility>

#include "transillum/at.h"
#include "visibility/fast/patch_engine.h"

namespace transillum::viewer {

namespace {

PerDirectionVisibility::VisibleAreas visible_areas_of(PatchId patch, const Transfers& transfers,
                                                      bool two_way) {
  PerDirectionVisibility::VisibleAreas areas;
  for (const Transfer& t : transfers.exchanges) {
    if (t.receiver == patch) {
      areas.forward.push_back({t.source, t.area});
    }
    if (two_way && t.source == patch) {
      areas.backward.push_back({t.receiver, t.area});
    }
  }
  return areas;
}

}  // namespace

PerDirectionVisibility::PerDirectionVisibility(QObject* parent)
    : QObject(parent),
      worker_(
          [this](const Task& task, const Cancellation& cancellation) { work(task, cancellation); },
          [this](const Task& task, const QString& message) {
            post_failure(message, task.number);
          }) {}

void PerDirectionVisibility::request(Request request) {
  const bool continues = request.patch == request_.patch &&
                         request.directions == request_.directions &&
                         request.two_way == request_.two_way && request.engine == request_.engine;
  if (continues && request.count <= request_.count) {
    return;
  }
  if (!continues) {
    found_.clear();
  }
  request_ = request;
  // Cancels the running job: the new one continues after the last delivered direction.
  worker_.request({std::move(request), static_cast<int>(found_.size()), ++number_});
}

void PerDirectionVisibility::clear() {
  request_ = {};
  found_.clear();
  ++number_;
  worker_.clear();
}

void PerDirectionVisibility::work(const Task& task, const Cancellation& cancellation) {
  using Clock = std::chrono::steady_clock;
  const Request& request = task.request;
  const bool same = engine_ && engine_request_.patch == request.patch &&
                    engine_request_.loaded == request.loaded &&
                    engine_request_.engine == request.engine &&
                    engine_request_.engine_options == request.engine_options;
  if (!same) {
    engine_ = make_patch_engine(request.engine, request.loaded->scene, request.loaded->tree,
                                request.patch, request.engine_options);
    engine_request_ = request;
  }
  std::vector<VisibleAreas> more;
  auto delivered = Clock::now();
  for (int k = task.first; k < request.count; ++k) {
    const Vec3& omega = at(*request.directions, k);
    more.push_back(visible_areas_of(request.patch, engine_(omega, cancellation), request.two_way));
    const bool last = k + 1 == request.count;
    if (!last && Clock::now() - delivered < std::chrono::milliseconds(200)) {
      continue;
    }
    delivered = Clock::now();
    QMetaObject::invokeMethod(
        this,
        [this, number = task.number, part = std::exchange(more, {})]() mutable {
          deliver(std::move(part), number);
        },
        Qt::QueuedConnection);
  }
}

void PerDirectionVisibility::deliver(std::vector<VisibleAreas> more, quint64 number) {
  if (number != number_) {
    return;
  }
  for (VisibleAreas& areas : more) {
    found_.push_back(std::move(areas));
  }
  emit grown();
}

void PerDirectionVisibility::post_failure(const QString& message, quint64 number) {
  const auto emit_failure = [this, message, number] {
    if (number == number_) {
      emit failed(message);
    }
  };
  QMetaObject::invokeMethod(this, emit_failure, Qt::QueuedConnection);
}

}  // namespace transillum::viewer
