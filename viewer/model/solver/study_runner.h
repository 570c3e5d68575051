// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QElapsedTimer>
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

/// The state of a study at one moment. Immutable.
struct StudySnapshot {
  std::shared_ptr<const LoadedScene> loaded;
  std::vector<StudySeries> series;
  Study study;  ///< points so far
  bool running = false;
  bool reference = false;     ///< computing the reference solution
  std::size_t under_way = 0;  ///< index of the series being computed
  int directions = 0;         ///< M being computed, or finished passes of the reference
  int passes = 0;             ///< all passes of the reference
  double fraction = 0;        ///< finished fraction of the work, 0 to 1
  double passes_per_second = 0, seconds_left = 0;
};

/// Runs studies of open scenes on its own thread; a newer study cancels the running one.
///
/// Threads: the public functions and all signals belong to the thread that created it. A snapshot
/// that has not been delivered yet is replaced by its successor.
class StudyRunner : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    StudyOptions options;
  };

  /// @param cache directory of the ReferenceCache
  explicit StudyRunner(std::filesystem::path cache, QObject* parent = nullptr);

  void start(Request request);
  /// Cancels the running or waiting study; a last snapshot with `running` false follows.
  void stop();

 signals:
  void snapshot_ready(std::shared_ptr<const transillum::viewer::StudySnapshot> snapshot);
  /// The study ended without points.
  void failed(const QString& message);

 private:
  // Called on the worker's thread, except post().
  void run(const Request& request, const Cancellation& cancellation);
  std::vector<Rgb> reference_radiosity(const Request& request, const Cancellation& cancellation);
  void post(StudySnapshot snapshot);
  void post_failure(const Request& request, const QString& message);
  bool due();

  const std::filesystem::path cache_;
  std::mutex mutex_;  // guards `pending_snapshot_`
  std::shared_ptr<const StudySnapshot> pending_snapshot_;

  QElapsedTimer since_post_;  // used by the worker's thread only
  RequestWorker<Request> worker_;
};

}  // namespace transillum::viewer
