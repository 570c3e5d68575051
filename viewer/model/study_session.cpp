// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/study_session.h"

#include <QMetaObject>
#include <chrono>
#include <utility>

#include "transillum/reference_cache.h"

namespace transillum::viewer {

namespace {

constexpr std::int64_t refresh_ns = 100'000'000;

std::int64_t now_ns() {
  using std::chrono::steady_clock;
  return std::chrono::nanoseconds(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

StudySession::StudySession(std::filesystem::path cache, QObject* parent)
    : QObject(parent),
      cache_(std::move(cache)),
      worker_([this](const Request& request, const Cancellation& cancellation) {
        run(request, cancellation);
      }) {}

void StudySession::start(Request request) { worker_.request(std::move(request)); }

void StudySession::stop() {
  const std::optional<Request> never_begun = worker_.clear();
  if (!never_begun) {
    return;
  }
  StudySnapshot ended;
  ended.loaded = never_begun->loaded;
  ended.series = never_begun->options.series;
  post(std::move(ended));
}

void StudySession::run(const Request& request, const Cancellation& cancellation) {
  StudySnapshot snapshot;
  snapshot.loaded = request.loaded;
  snapshot.series = request.options.series;
  QString failure;
  try {
    const std::vector<Rgb> reference = reference_radiosity(request, cancellation);
    snapshot.study = run_study(
        request.loaded->scene, request.loaded->tree, request.options, reference,
        [&](const StudyProgress& now) {
          if (!due()) {
            return;
          }
          StudySnapshot newest = snapshot;
          newest.running = true;
          newest.under_way = now.series;
          newest.directions = now.directions;
          newest.share = now.share;
          newest.passes_per_second = now.passes_per_second;
          newest.seconds_left = now.seconds_left;
          newest.study.points.assign(now.points.begin(), now.points.end());
          post(std::move(newest));
        },
        cancellation);
  } catch (const Canceled&) {
  } catch (const std::exception& error) {
    failure = QString::fromUtf8(error.what());
  }
  post(std::move(snapshot));
  if (failure.isEmpty()) {
    return;
  }
  QMetaObject::invokeMethod(
      this, [this, failure] { emit failed(failure); }, Qt::QueuedConnection);
}

std::vector<Rgb> StudySession::reference_radiosity(const Request& request,
                                                   const Cancellation& cancellation) {
  const Scene& scene = *request.loaded->scene;
  const SolveOptions options = request.options.reference();
  const ReferenceCache cache(cache_);
  if (auto kept = cache.find(scene, options)) {
    return *std::move(kept);
  }
  std::vector<Rgb> radiosity = solve_reference(
      request.loaded->scene, request.loaded->tree, options,
      [&](const SolveProgress& now) {
        if (now.direction == 0 || !due()) {
          return;
        }
        StudySnapshot newest;
        newest.loaded = request.loaded;
        newest.series = request.options.series;
        newest.running = newest.reference = true;
        newest.directions = now.direction;
        newest.passes = now.passes;
        newest.share = static_cast<double>(now.direction) / now.passes;
        newest.passes_per_second = now.passes_per_second;
        newest.seconds_left = now.seconds_left;
        post(std::move(newest));
      },
      cancellation);
  try {
    cache.store(scene, options, radiosity);
  } catch (const std::exception&) {  // it costs the time to make it again, no more
  }
  return radiosity;
}

bool StudySession::due() {
  const std::int64_t now = now_ns();
  if (now - last_post_ns_ < refresh_ns) {
    return false;
  }
  last_post_ns_ = now;
  return true;
}

void StudySession::post(StudySnapshot snapshot) {
  const std::lock_guard lock(mutex_);
  const bool waiting = mailbox_ != nullptr;
  mailbox_ = std::make_shared<const StudySnapshot>(std::move(snapshot));
  if (waiting) {
    return;
  }
  QMetaObject::invokeMethod(
      this,
      [this] {
        std::shared_ptr<const StudySnapshot> newest;
        {
          const std::lock_guard mailbox_lock(mutex_);
          newest = std::exchange(mailbox_, nullptr);
        }
        emit snapshot_ready(newest);
      },
      Qt::QueuedConnection);
}

}  // namespace transillum::viewer
