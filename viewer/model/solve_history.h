// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <vector>

#include "model/snapshot.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

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
  /// linear parts.
  void write_to(SolverSnapshot& snapshot);

 private:
  void store_radiosity(const SolveSession& session);
  void store_directions(const SolveSession& session);
  void store_errors(const SolveSession& session);

  // The values of members of SolverSnapshot.
  std::vector<std::shared_ptr<const std::vector<Vec3>>> directions_;
  std::vector<int> passes_;
  std::vector<std::shared_ptr<const std::vector<Rgb>>> radiosity_;
  std::vector<std::shared_ptr<const std::vector<LinearPart>>> linear_parts_;
  std::vector<ErrorBand> errors_;

  int replicas_ = 1;             // the number of replicas whose directions are in
                                 // directions_.front()
  std::vector<double> changes_;  // changes of the newest iteration with all its passes
  int changes_iteration_ = 0;
  std::shared_ptr<const std::vector<LinearBasis>> bases_;  // null until they are needed
};

}  // namespace transillum::viewer
