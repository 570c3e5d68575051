// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <cstdint>
#include <memory>

#include "model/requests/recorded_map.h"
#include "support/request_worker.h"

namespace transillum::viewer {

/// Records visibility maps on its own thread, in parallel with the solver; the newest request
/// replaces the waiting one, and the map being recorded is finished.
///
/// Threads: the public functions and the signals belong to the thread that created it.
class MapRecorder : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    Vec3 omega;
    int iteration = 0;         ///< from 0
    int direction = 0;         ///< from 0: number of the pass
    int passes = 0;            ///< M, of the iteration
    std::uint64_t memory = 0;  ///< SolveOptions::memory
    bool patient = false;  ///< waits for the pause after the last map, to leave time to the solver
  };

  explicit MapRecorder(QObject* parent = nullptr);

  void request(Request request);
  /// Cancels the running request, removes the waiting one and drops undelivered results.
  void clear();
  /// Whether a requested map has not been delivered yet.
  bool busy() const { return newest_ != delivered_; }

 signals:
  void recorded(std::shared_ptr<const transillum::viewer::RecordedMap> map);
  void failed(const QString& message);

 private:
  struct Task {
    Request request;
    quint64 number;
  };
  void work(const Task& task, const Cancellation& cancellation);
  void deliver(const std::shared_ptr<const RecordedMap>& map, const QString& error, quint64 number);

  quint64 newest_ = 0, delivered_ = 0;  // numbers of requests; used by the owner's thread only

  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
