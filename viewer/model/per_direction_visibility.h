// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "support/request_worker.h"
#include "transillum/engine.h"

namespace transillum::viewer {

/// What one patch sees along each direction of a run, found beside the solver on a thread of its
/// own; the newest request wins. What was found for the same patch and run is kept.
///
/// Threads: the public functions and the signals belong to the thread that made it.
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
    int count = 0;  ///< of the directions, the first so many
    PatchId patch = no_patch;
  };

  explicit PerDirectionVisibility(QObject* parent = nullptr);

  void request(Request request);
  /// Gives up what is under way, and forgets what was found.
  void clear();
  /// A direction each, the first ones of the run, for the patch asked for last.
  const std::vector<VisibleAreas>& found() const { return found_; }
  const Request& current_request() const { return wanted_; }
  bool complete() const { return static_cast<int>(found_.size()) >= wanted_.count; }

 signals:
  void grown();

 private:
  struct Task {
    Request request;
    int first;  ///< direction that is not found yet
    quint64 number;
  };
  void look(const Task& task, const Cancellation& cancellation);
  void deliver(std::vector<VisibleAreas> more, quint64 number);

  // The window's own.
  Request wanted_;
  std::vector<VisibleAreas> found_;
  quint64 number_ = 0;  ///< of the newest request; what belongs to another is dropped

  // The worker's own: what it looked with last.
  TransferEngine engine_;
  Request engine_of_;

  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
