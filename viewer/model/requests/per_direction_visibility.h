// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <iterator>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "support/request_worker.h"
#include "transillum/engine.h"

namespace transillum::viewer {

/// Finds what one patch sees along each direction of a solve run, on its own thread while the
/// solver runs; the newest request replaces older ones. Results for the same patch and run are
/// kept.
///
/// Threads: the public functions and the signals belong to the thread that created it.
class PerDirectionVisibility : public QObject {
  Q_OBJECT

 public:
  /// The patch sees `area` m² of `source`, projected along the direction.
  struct VisibleArea {
    PatchId source;
    double area;
  };
  /// Along omega, and along its opposite.
  struct VisibleAreas {
    std::vector<VisibleArea> forward, backward;
  };
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    Engine engine = Engine::fast;
    EngineOptions engine_options;
    bool two_way = true;
    std::shared_ptr<const std::vector<Vec3>> directions;
    int count = 0;  ///< how many of `directions`, from the first
    PatchId patch = no_patch;
  };

  explicit PerDirectionVisibility(QObject* parent = nullptr);

  void request(Request request);
  /// Cancels the running request and drops all results.
  void clear();
  /// Results of the current request so far, one per direction, from the first.
  const std::vector<VisibleAreas>& found() const { return found_; }
  const Request& current_request() const { return request_; }
  bool complete() const { return std::ssize(found_) >= request_.count; }

 signals:
  void grown();  ///< found() has more directions
  void failed(const QString& message);

 private:
  struct Task {
    Request request;
    int first;  ///< direction without a result
    quint64 number;
  };
  void work(const Task& task, const Cancellation& cancellation);
  void deliver(std::vector<VisibleAreas> more, quint64 number);
  void post_failure(const QString& message, quint64 number);

  // Used by the owner's thread only.
  Request request_;
  std::vector<VisibleAreas> found_;
  quint64 number_ = 0;  ///< number of the newest request; results of others are dropped

  // Used by the worker's thread only.
  TransferEngine engine_;
  Request engine_request_;  ///< that engine_ was created for

  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
