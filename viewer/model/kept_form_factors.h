// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "model/snapshot.h"
#include "transillum/solve_session.h"

namespace transillum::viewer {

/// The form factors of a stage for its snapshots, as soon as they are requested.
///
/// Threads: request() may be called by any thread; the others belong to the worker's thread.
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
