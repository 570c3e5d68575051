// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <string>
#include <vector>

#include "model/snapshot.h"
#include "support/request_worker.h"
#include "transillum/transfer_comparison.h"

namespace transillum::viewer {

/// Two engines on the same direction; or, where one of them is a hemicube and knows none, what one
/// patch sees by both, over all directions of the run.
struct EngineComparison {
  struct Side {
    Engine engine = Engine::fast;
    int resolution = 0;        ///< EngineOptions::resolution
    double seconds = 0;        ///< processor time of the direction, or row; one thread
    std::size_t pairs = 0;     ///< that exchange light
    double covered_share = 0;  ///< of all that receives, what has a surface above it
    std::string failure;       ///< why there is nothing of it
  };
  std::shared_ptr<const LoadedScene> loaded;
  Vec3 direction;
  PatchId eye = no_patch;  ///< whose row was compared, if one was
  Side first, other;
  TransferComparison transfers;   ///< where neither failed; of a row A_i F_ij, m²
  std::vector<double> projected;  ///< a patch: its area on the plane, m²; or half of A_i F_ij

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
    // Where one is a hemicube:
    PatchId eye = no_patch;
    std::shared_ptr<const std::vector<Vec3>> directions;
    bool two_way = true;

    bool compares_rows() const { return first == Engine::hemicube || other == Engine::hemicube; }
    friend bool operator==(const Request&, const Request&) = default;
  };

  explicit EngineComparer(QObject* parent = nullptr);

  void request(Request request);
  /// Gives up what is under way.
  void clear();

 signals:
  void compared(std::shared_ptr<const transillum::viewer::EngineComparison> comparison);

 private:
  struct Task {
    Request request;
    quint64 number;
  };
  void work(const Task& task, const Cancellation& cancellation);

  quint64 number_ = 0;  ///< of the newest request; what belongs to another is dropped
  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
