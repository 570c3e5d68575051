// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/per_direction_visibility.h"

#include <QMetaObject>
#include <chrono>
#include <utility>

#include "transillum/at.h"
#include "transillum/patch_engine.h"

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
    : QObject(parent), worker_([this](const Task& task, const Cancellation& cancellation) {
        try {
          look(task, cancellation);
        } catch (const std::exception&) {
          // Canceled, or the engine's failure, which the solver has told already.
        }
      }) {}

void PerDirectionVisibility::request(Request request) {
  const bool goes_on = request.patch == wanted_.patch && request.directions == wanted_.directions &&
                       request.two_way == wanted_.two_way && request.engine == wanted_.engine;
  if (goes_on && request.count <= wanted_.count) {
    return;
  }
  if (!goes_on) {
    found_.clear();
  }
  wanted_ = request;
  // What is under way is dropped: it would come back later with more.
  worker_.request({std::move(request), static_cast<int>(found_.size()), ++number_});
}

void PerDirectionVisibility::clear() {
  wanted_ = {};
  found_.clear();
  ++number_;
  worker_.clear();
}

void PerDirectionVisibility::look(const Task& task, const Cancellation& cancellation) {
  using Clock = std::chrono::steady_clock;
  const Request& request = task.request;
  const bool same = engine_ && engine_of_.patch == request.patch &&
                    engine_of_.loaded == request.loaded && engine_of_.engine == request.engine &&
                    engine_of_.engine_options == request.engine_options;
  if (!same) {
    engine_ = make_patch_engine(request.engine, request.loaded->scene, request.loaded->tree,
                                request.patch, request.engine_options);
    engine_of_ = request;
  }
  std::vector<VisibleAreas> more;
  auto delivered = Clock::now();
  for (int k = task.first; k < request.count; ++k) {
    const Vec3& omega = at((*request.directions), k);
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

}  // namespace transillum::viewer
