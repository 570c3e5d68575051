// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "model/recorded_map.h"
#include "transillum/cancellation.h"

namespace transillum::viewer {

/// Records visibility maps beside the solver, on a thread of its own; the newest request wins.
///
/// Threads: the public functions and the signals belong to the thread that made it.
class MapRecorder : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    Vec3 omega;
    int iteration = 0;     ///< from 0
    int direction = 0;     ///< from 0: number of the pass
    int passes = 0;        ///< of the step: M
    bool patient = false;  ///< may wait, to leave time to the solver
  };

  explicit MapRecorder(QObject* parent = nullptr);
  ~MapRecorder() override;

  void request(Request request);
  /// Gives up what is under way and what waits.
  void clear();
  /// Whether a map that was asked for has not been delivered yet.
  bool busy() const { return asked_ != delivered_; }

 signals:
  void recorded(std::shared_ptr<const transillum::viewer::RecordedMap> map);
  void failed(const QString& message);

 private:
  void work();
  void deliver(const std::shared_ptr<const RecordedMap>& map, const QString& error, quint64 number);

  quint64 asked_ = 0, delivered_ = 0;  // the window's own

  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Request> request_;
  quint64 request_number_ = 0;
  bool quit_ = false;
  Cancellation cancellation_;
  std::thread worker_;
};

}  // namespace transillum::viewer
