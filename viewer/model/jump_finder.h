// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "support/newest_result.h"

namespace transillum::viewer {

/// The difference between B of each patch and B of its neighbors.
struct PatchJumps {
  std::shared_ptr<const Scene> scene;
  std::vector<double> values;  ///< radiosity_jumps(), W/m², one per patch
};

/// Computes the jumps of snapshots on its own thread, one after the other: while one is being
/// computed, only the newest of later requests is kept.
///
/// Threads: functions and signals belong to the thread that created it.
class JumpFinder : public QObject {
  Q_OBJECT

 public:
  explicit JumpFinder(QObject* parent = nullptr);

  /// Nothing happens if it is the snapshot of the last call.
  void request(std::shared_ptr<const SolverSnapshot> snapshot);
  /// Releases the snapshot and its jumps; a computation that runs is canceled.
  void clear();
  /// The newest jumps, which may belong to an older snapshot; null if none have been computed or
  /// the last request failed.
  std::shared_ptr<const PatchJumps> jumps() const { return jumps_; }
  /// Why the last request failed; else empty.
  const QString& error() const { return error_; }
  bool busy() const { return finder_.busy(); }

 signals:
  /// jumps() or error() has changed.
  void changed();

 private:
  using Request = std::shared_ptr<const SolverSnapshot>;

  Request wanted_, started_;
  std::shared_ptr<const PatchJumps> jumps_;
  QString error_;
  NewestResult<Request, PatchJumps> finder_;
};

}  // namespace transillum::viewer
