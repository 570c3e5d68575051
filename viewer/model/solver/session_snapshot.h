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

/// A snapshot with the values and statistics of the present stage of a session. Before the first
/// pass, it has the values of the result file, if one was opened.
/// @param session prepared
/// @param loaded of the session's scene
SolverSnapshot snapshot_of(const SolveSession& session, std::shared_ptr<const LoadedScene> loaded);

/// The data of all iterations of a stage that snapshots show: directions, passes, B, errors, and
/// the changes of the estimate in the newest iteration with passes.
class SolveHistory {
 public:
  /// A history of no stage, which may only be assigned to.
  SolveHistory() = default;
  /// @param session prepared; iterations that it has made before are included, except their B
  explicit SolveHistory(const SolveSession& session);

  /// To be called after each pass and iteration, and when a replica was added.
  void update(const SolveSession& session);
  /// Sets the history of a snapshot whose other values are set, and the members that follow from
  /// linear terms.
  void write_to(SolverSnapshot& snapshot);

 private:
  void store_radiosity(const SolveSession& session);
  void store_directions(const SolveSession& session);
  void store_errors(const SolveSession& session);

  // The values of members of SolverSnapshot.
  std::vector<std::shared_ptr<const std::vector<Vec3>>> directions_;
  std::vector<int> passes_;
  std::vector<std::shared_ptr<const std::vector<Rgb>>> radiosity_;
  std::vector<std::shared_ptr<const std::vector<LinearTerm>>> linear_terms_;
  std::vector<ErrorBand> errors_;

  int replicas_ = 1;             // the number of replicas whose directions are in
                                 // directions_.front()
  std::vector<double> changes_;  // changes of the newest iteration with all its passes
  int changes_iteration_ = 0;
  std::shared_ptr<const std::vector<LinearBasis>> bases_;  // null until they are needed
};

/// The form factors of a stage for its snapshots, as soon as they are requested.
///
/// Threads: request() may be called by any; the others belong to the worker's thread.
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
