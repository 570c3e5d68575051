// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/error/error_estimate.h"
#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/running_mean.h"
#include "radiosity/solver/solver_input.h"

namespace transillum {

/// The radiosity of each of R independently rotated sets of directions, whose spread is the error
/// estimate (eq. 47). Empty for one replica.
class Replicas {
 public:
  /// Keeps a reference to the unknowns of `input`.
  explicit Replicas(const SolverInput& input);

  /// Adds one replica, which starts from B of `whole`.
  void add_replica(const SolverInput& input, const RadiosityIterate& whole);
  /// Adds a pass to the iteration of replica r; nothing for one replica.
  void add(std::size_t r, const Transfers& transfers);
  /// Ends the iteration of every replica.
  void finish();
  /// Adds B of every replica to its mean over iterations (semi-iterative scheme).
  void add_to_means();
  /// Calls visit(iterate, r) for every replica r.
  template <class Visit>
  void for_each(Visit visit) {
    for (std::size_t r = 0; r < iterates_.size(); ++r) {
      visit(iterates_[r], r);
    }
  }

  /// Which radiosity an error estimate is for.
  enum class Radiosity { finished_iteration, running_estimate, mean };
  /// The error of `b`, the value of the given kind; no estimate without replicas, or before every
  /// replica has a pass.
  /// @param h irradiance that belongs to `b`, for Radiosity::finished_iteration
  ErrorEstimate error_estimate(const Scene& scene, const std::vector<Rgb>& b,
                               const std::vector<Rgb>& h, Radiosity kind) const;
  const ErrorSurfaces& surfaces() const { return surfaces_; }

  /// For StateOutput and StateInput; the number of replicas must be the same.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    for (std::size_t r = 0; r < self.iterates_.size(); ++r) {
      archive(self.iterates_[r]);
      RunningMean::visit_state(archive, self.means_[r], self.iterates_[r].b().size());
    }
  }

 private:
  std::vector<Rgb> radiosity(std::size_t r, Radiosity kind) const;

  ErrorSurfaces surfaces_;
  std::vector<RadiosityIterate> iterates_;
  std::vector<RunningMean> means_;
};

}  // namespace transillum
