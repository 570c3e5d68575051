// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Runs a study (errors over numbers of directions) and posts its progress to the window. The
// reference solution comes from the cache, or is solved and stored there.
#include "model/solver/study_runner.h"

#include <QMetaObject>
#include <utility>

#include "io/results/reference_cache.h"

namespace transillum::viewer {

namespace {

constexpr qint64 refresh_interval_ms = 100;

/// A snapshot in which nothing has been done and nothing runs.
StudySnapshot without_points(const StudyRunner::Request& request) {
  StudySnapshot snapshot;
  snapshot.loaded = request.loaded;
  snapshot.series = request.options.series;
  return snapshot;
}

}  // namespace

StudyRunner::StudyRunner(std::filesystem::path cache, QObject* parent)
    : QObject(parent),
      cache_(std::move(cache)),
      worker_([this](const Request& request,
                     const Cancellation& cancellation) { run(request, cancellation); },
              [this](const Request& request, const QString& message) {
                post_failure(request, message);
              }) {}

void StudyRunner::start(Request request) { worker_.request(std::move(request)); }

void StudyRunner::stop() {
  if (const std::optional<Request> never_begun = worker_.clear()) {
    post(without_points(*never_begun));
  }
}

void StudyRunner::run(const Request& request, const Cancellation& cancellation) {
  StudySnapshot snapshot = without_points(request);
  try {
    const std::vector<Rgb> reference = reference_radiosity(request, cancellation);
    snapshot.study = run_study(
        request.loaded->scene, request.loaded->tree, request.options, {reference},
        [&](const StudyProgress& now) {
          if (!due()) {
            return;
          }
          StudySnapshot newest = snapshot;
          newest.running = true;
          newest.under_way = now.series;
          newest.directions = now.directions;
          newest.fraction = now.fraction;
          newest.passes_per_second = now.passes_per_second;
          newest.seconds_left = now.seconds_left;
          newest.study.points.assign(now.points.begin(), now.points.end());
          post(std::move(newest));
        },
        cancellation);
  } catch (const Canceled&) {
    // The last snapshot reports that the study has ended.
  }
  post(std::move(snapshot));
}

void StudyRunner::post_failure(const Request& request, const QString& message) {
  post(without_points(request));
  QMetaObject::invokeMethod(
      this, [this, message] { emit failed(message); }, Qt::QueuedConnection);
}

std::vector<Rgb> StudyRunner::reference_radiosity(const Request& request,
                                                  const Cancellation& cancellation) {
  // If the cache cannot be written, the next study solves the reference again.
  ReferenceSolution reference = find_or_solve_reference(
      ReferenceCache(cache_), request.loaded->scene, request.loaded->tree,
      request.options.reference(),
      [&](const SolveProgress& now) {
        if (now.direction == 0 || !due()) {
          return;
        }
        StudySnapshot newest = without_points(request);
        newest.running = newest.reference = true;
        newest.directions = now.direction;
        newest.passes = now.passes;
        newest.fraction = static_cast<double>(now.direction) / now.passes;
        newest.passes_per_second = now.passes_per_second;
        newest.seconds_left = now.seconds_left;
        post(std::move(newest));
      },
      cancellation);
  return std::move(reference.radiosity);
}

bool StudyRunner::due() {
  if (since_post_.isValid() && since_post_.elapsed() < refresh_interval_ms) {
    return false;
  }
  since_post_.start();
  return true;
}

void StudyRunner::post(StudySnapshot snapshot) {
  const std::lock_guard lock(mutex_);
  const bool waiting = pending_snapshot_ != nullptr;
  pending_snapshot_ = std::make_shared<const StudySnapshot>(std::move(snapshot));
  if (waiting) {
    return;
  }
  QMetaObject::invokeMethod(
      this,
      [this] {
        std::shared_ptr<const StudySnapshot> newest;
        {
          const std::lock_guard delivery_lock(mutex_);
          newest = std::exchange(pending_snapshot_, nullptr);
        }
        emit snapshot_ready(newest);
      },
      Qt::QueuedConnection);
}

}  // namespace transillum::viewer
