// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What a snapshot shows of a session: its values, its history over the iterations of a stage, and
// its form factors.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

/// A snapshot with the values and figures of the stage of a session. Before its first pass, those
/// of the result file, if one was opened.
/// @param session prepared
/// @param loaded of the session's scene
SolverSnapshot snapshot_of(const SolveSession& session, std::shared_ptr<const LoadedScene> loaded);

/// What snapshots show of all iterations of a stage: directions, passes, B, errors, and the changes
/// of the estimate in the newest iteration with passes.
class SolveHistory {
 public:
  /// Of no stage; it may only be assigned to.
  SolveHistory() = default;
  /// @param session prepared; iterations that it has made before are included, but for their B
  explicit SolveHistory(const SolveSession& session);

  /// To be called after each pass and iteration, and when a replica was added.
  void update(const SolveSession& session);
  /// Sets the history, and what follows from linear parts, of a snapshot that has its other values.
  void write_to(SolverSnapshot& snapshot);

 private:
  void store_radiosity(const SolveSession& session);
  void store_directions(const SolveSession& session);
  void store_errors(const SolveSession& session);

  // As in SolverSnapshot.
  std::vector<std::shared_ptr<const std::vector<Vec3>>> directions_;
  std::vector<int> passes_;
  std::vector<std::shared_ptr<const std::vector<Rgb>>> radiosity_;
  std::vector<std::shared_ptr<const std::vector<LinearPart>>> linear_parts_;
  std::vector<ErrorBand> errors_;

  int replicas_ = 1;             // that have directions in directions_.front()
  std::vector<double> changes_;  // of the newest iteration with all its passes
  int changes_iteration_ = 0;
  std::shared_ptr<const std::vector<LinearBasis>> bases_;  // null: not needed yet
};

/// The form factors of a stage for its snapshots, from the moment on when they are requested.
///
/// Threads: request() may be called by any; the others belong to the worker's.
class KeptFormFactors {
 public:
  /// @returns whether they were not requested before
  bool request() { return !requested_.exchange(true); }
  /// Whether a snapshot should be made for them. They are complete only between iterations, where
  /// few snapshots are made. In the semi-iterative scheme, they are assembled again when the number
  /// of passes has doubled.
  bool are_due(const SolveSession& session) const;
  /// Assembles them if they are complete and fit into the memory limit.
  void update(const SolveSession& session);
  void write_to(SolverSnapshot& snapshot) const;
  /// Another stage begins.
  void clear();

 private:
  bool can_assemble(const SolveSession& session) const;

  std::atomic<bool> requested_ = false;
  std::shared_ptr<const FormFactors> factors_;
  std::int64_t passes_ = 0;  // in factors_
  bool fit_ = true;
};

}  // namespace transillum::viewer
