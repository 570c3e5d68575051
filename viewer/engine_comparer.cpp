// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "engine_comparer.h"

#include <QMetaObject>
#include <ctime>
#include <utility>

#include "transillum/engine.h"
#include "transillum/errors.h"

namespace transillum::viewer {

namespace {

/// Of this thread, on a processor: what others do does not count.
double thread_seconds() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Fills in what is known of one engine; throws Cancelled only.
Transfers run_engine(const EngineComparer::Request& request, EngineComparison::Side& side,
                     const Cancellation& cancellation) {
  Transfers transfers;
  try {
    EngineOptions options = request.options;
    options.resolution = side.resolution;
    const TransferEngine engine =
        make_engine(side.engine, request.loaded->scene, request.loaded->tree, options);
    // The first run of an engine finds its memory; where it is short a second one is timed.
    for (int run = 0; run < 2 && (run == 0 || side.seconds < 0.1); ++run) {
      const double start = thread_seconds();
      transfers = engine(request.direction, cancellation);
      side.seconds = thread_seconds() - start;
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    side.failure = error.what();
  }
  side.pairs = transfers.exchanges.size();
  double projected = 0, covered = 0;
  for (const auto* sides : {&transfers.forward, &transfers.backward}) {
    for (const Coverage& coverage : *sides) {
      projected += coverage.projected;
      covered += coverage.covered;
    }
  }
  side.covered_share = projected > 0 ? covered / projected : 0;
  return transfers;
}

EngineComparison compare_engines(const EngineComparer::Request& request,
                                 const Cancellation& cancellation) {
  EngineComparison comparison;
  comparison.loaded = request.loaded;
  comparison.direction = request.direction;
  comparison.first.engine = request.first;
  comparison.first.resolution = request.first_resolution;
  comparison.other.engine = request.other;
  comparison.other.resolution = request.other_resolution;
  const Transfers first = run_engine(request, comparison.first, cancellation);
  const Transfers other = run_engine(request, comparison.other, cancellation);
  if (!comparison.ok()) return comparison;
  comparison.transfers = compare(first, other);
  for (std::size_t i = 0; i < first.forward.size(); ++i) {
    comparison.projected.push_back(first.forward[i].projected + first.backward[i].projected);
  }
  return comparison;
}

}  // namespace

EngineComparer::EngineComparer(QObject* parent)
    : QObject(parent), worker_([this](const Task& task, const Cancellation& cancellation) {
        work(task, cancellation);
      }) {}

void EngineComparer::request(Request request) { worker_.request({std::move(request), ++number_}); }

void EngineComparer::clear() {
  ++number_;
  worker_.clear();
}

void EngineComparer::work(const Task& task, const Cancellation& cancellation) {
  auto done = std::make_shared<const EngineComparison>(compare_engines(task.request, cancellation));
  QMetaObject::invokeMethod(
      this,
      [this, number = task.number, done = std::move(done)] {
        if (number == number_) emit compared(done);
      },
      Qt::QueuedConnection);
}

}  // namespace transillum::viewer
