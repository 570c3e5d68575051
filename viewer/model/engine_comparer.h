// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <memory>
#include <string>
#include <vector>

#include "model/snapshot.h"
#include "support/request_worker.h"
#include "visibility/transfers/transfer_comparison.h"

namespace transillum::viewer {

/// Two engines on the same direction. If one has no directions (hemicube, pairs): the row of form
/// factors of one patch by both engines, over all directions of the solve run.
struct EngineComparison {
  struct Side {
    Engine engine = Engine::fast;
    int resolution = 0;        ///< EngineOptions::resolution
    double seconds = 0;        ///< processor time of the direction or row, one thread
    std::size_t pairs = 0;     ///< number of pairs of patches that exchange light
    double covered_share = 0;  ///< covered over projected area of all receivers, 0 to 1
    std::string failure;       ///< why the engine gave no result; empty on success
  };
  std::shared_ptr<const LoadedScene> loaded;
  Vec3 direction;
  PatchId eye = no_patch;  ///< patch whose row was compared; no_patch if a direction was compared
  Side first, other;
  TransferComparison transfers;   ///< set if ok(); for a row A_i F_ij, m²
  std::vector<double> projected;  ///< per patch: its area on the plane, m²; or half of A_i F_ij

  bool ok() const { return first.failure.empty() && other.failure.empty(); }
};

/// Compares engines on its own thread; the newest request replaces older ones.
///
/// Threads: the public functions and the signal belong to the thread that created it.
class EngineComparer : public QObject {
  Q_OBJECT

 public:
  struct Request {
    std::shared_ptr<const LoadedScene> loaded;
    Vec3 direction;
    EngineOptions options;  ///< except the resolution
    Engine first = Engine::fast, other = Engine::corrected;
    int first_resolution = 0, other_resolution = 0;
    // Used if an engine has no directions:
    PatchId eye = no_patch;
    std::shared_ptr<const std::vector<Vec3>> directions;
    bool two_way = true;

    bool compares_rows() const { return !takes_directions(first) || !takes_directions(other); }
    friend bool operator==(const Request&, const Request&) = default;
  };

  explicit EngineComparer(QObject* parent = nullptr);

  void request(Request request);
  /// Cancels the running request; nothing more is delivered.
  void clear();

 signals:
  /// A failure is in `comparison->first.failure` or `other.failure`.
  void compared(std::shared_ptr<const transillum::viewer::EngineComparison> comparison);

 private:
  struct Task {
    Request request;
    quint64 number;
  };
  void deliver(const Task& task, EngineComparison comparison);

  quint64 number_ = 0;  ///< number of the newest request; results of others are dropped
  RequestWorker<Task> worker_;
};

}  // namespace transillum::viewer
