// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "snapshot.h"
#include "transillum/cancellation.h"
#include "transillum/transfer_comparison.h"

namespace transillum::viewer {

/// Two engines on the same direction.
struct EngineComparison {
  struct Side {
    Engine engine = Engine::fast;
    int resolution = 0;        ///< EngineOptions::resolution
    double seconds = 0;        ///< processor time of one direction, on one thread
    std::size_t pairs = 0;     ///< that exchange light
    double covered_share = 0;  ///< of all that receives, what has a surface above it
    std::string failure;       ///< why there is nothing of it
  };
  std::shared_ptr<const LoadedScene> loaded;
  Vec3 direction;
  Side first, other;
  TransferComparison transfers;   ///< where neither failed
  std::vector<double> projected;  ///< a patch: its area on the plane, m²

  bool ok() const { return first.failure.empty() && other.failure.empty(); }
};

/// Compares engines on a thread of its own; the newest request wins.
///
/// Threads: the public functions and the signal belong to the thread that made it.
class EngineComparer : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    Vec3 direction;
    EngineOptions options;  ///< but for the resolution
    Engine first = Engine::fast, other = Engine::corrected;
    int first_resolution = 0, other_resolution = 0;

    friend bool operator==(const Request&, const Request&) = default;
  };

  explicit EngineComparer(QObject* parent = nullptr);
  ~EngineComparer() override;

  void request(Request request);
  /// Gives up what is under way.
  void clear();

 signals:
  void compared(std::shared_ptr<const transillum::viewer::EngineComparison> comparison);

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Request> request_;
  quint64 number_ = 0;
  bool quit_ = false;
  Cancellation cancellation_;
  std::thread worker_;
};

}  // namespace transillum::viewer
