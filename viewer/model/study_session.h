// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "model/snapshot.h"
#include "support/request_worker.h"
#include "transillum/study.h"

namespace transillum::viewer {

/// Where a study stands at one moment. Immutable.
struct StudySnapshot {
  std::shared_ptr<const LoadedScene> loaded;
  std::vector<StudySeries> series;
  Study study;  ///< the points so far
  bool running = false;
  bool reference = false;     ///< still making what others are compared with
  std::size_t under_way = 0;  ///< series
  int directions = 0;         ///< M under way, or passes of the reference done
  int passes = 0;             ///< of the reference
  double share = 0, passes_per_second = 0, seconds_left = 0;
};

/// Runs studies of open scenes on a thread of its own; the newest one wins.
///
/// Threads: the public functions and all signals belong to the thread that made it. A snapshot that
/// the window has not taken yet is replaced by its successor.
class StudySession : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    StudyOptions options;
  };

  /// @param cache where references are kept (ReferenceCache)
  explicit StudySession(std::filesystem::path cache, QObject* parent = nullptr);

  void start(Request request);
  /// Ends the study under way, or one that waits; a last snapshot tells so.
  void stop();

 signals:
  void snapshot_ready(std::shared_ptr<const transillum::viewer::StudySnapshot> snapshot);
  /// The study ended without points.
  void failed(const QString& message);

 private:
  // The worker's own from here on.
  void run(const Request& request, const Cancellation& cancellation);
  std::vector<Rgb> reference_radiosity(const Request& request, const Cancellation& cancellation);
  void post(StudySnapshot snapshot);
  bool due();

  const std::filesystem::path cache_;
  std::mutex mutex_;  // guards `mailbox_`
  std::shared_ptr<const StudySnapshot> mailbox_;

  std::int64_t last_post_ns_ = 0;
  RequestWorker<Request> worker_;
};

}  // namespace transillum::viewer
