// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <cstdint>
#include <memory>

#include "model/snapshot.h"
#include "support/request_worker.h"

namespace transillum::viewer {

/// Finds on its own thread how many patches a limit of their area makes of a scene.
///
/// Threads: the public functions and all signals belong to the thread that created it.
class PatchForecast : public QObject {
  Q_OBJECT

 public:
  explicit PatchForecast(QObject* parent = nullptr);

  /// A newer request replaces an older one.
  /// @param loaded with a description
  void request(std::shared_ptr<const LoadedScene> loaded, const SceneOptions& options);

 signals:
  /// @param patches at least 2^62 where there are more
  void counted(const transillum::SceneOptions& options, std::int64_t patches);
  void failed(const QString& message);

 private:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    SceneOptions options;
  };
  // On the worker's thread.
  void count(const Request& request, const Cancellation& cancellation);
  std::shared_ptr<const Scene> unrefined(const Request& request, const Cancellation& cancellation);

  // Used by the worker's thread only: the faces of the last request, not divided.
  std::weak_ptr<const LoadedScene> counted_;
  std::shared_ptr<const Scene> faces_;
  RequestWorker<Request> worker_;
};

}  // namespace transillum::viewer
