// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/running_mean.h"
#include "transillum/radiosity.h"

namespace transillum {

/// The finished iterations: their records, B and H they lead to, and whether the solve is done.
///
/// B and H are those of the last iteration; of the semi-iterative scheme after burn_in iterations
/// the mean over those since (eq. 45).
class IterationHistory {
 public:
  /// @param first B before any iteration
  IterationHistory(const SolveOptions& options, const RadiosityIterate& first);

  int size() const { return static_cast<int>(records_.size()); }
  const std::vector<IterationRecord>& records() const { return records_; }
  const std::vector<Rgb>& b() const { return b_; }  ///< W/m²
  const std::vector<Rgb>& h() const { return h_; }  ///< W/m²
  bool finished() const { return finished_; }       ///< no iteration is left to do
  bool converged() const { return converged_; }
  double energy_defect() const { return energy_defect_; }  ///< of the last iteration

  /// Whether b() is a mean over iterations.
  bool averaged() const { return mean_b_.count > 0; }
  /// Whether the iteration under way will count in the mean.
  bool past_burn_in() const { return semi_iterative() && size() >= options_.burn_in; }
  /// What b()[i] becomes if the iteration under way ends with B_i = `value`.
  Rgb with(std::size_t i, const Rgb& value) const;

  /// Sets B and H after an iteration that ended with `iterate`. Returns the largest change of B.
  /// @param change largest change of iterate.b()
  double update(const RadiosityIterate& iterate, double change);
  /// Records the iteration and applies the stopping rule of eq. 25.
  /// @param change largest change of B, as update() returned it
  /// @param complete whether the iteration used all M directions
  /// @throws NotConvergent where changes have grown for several iterations
  void record(double change, double seconds, bool complete, double energy_defect);

 private:
  bool semi_iterative() const { return options_.scheme == Scheme::semi_iterative; }
  double update_mean(const RadiosityIterate& iterate);
  /// rho times the row sums of F is above 1 where there are too few directions.
  void check_contraction() const;

  SolveOptions options_;
  std::vector<Rgb> b_, h_;
  RunningMean mean_b_, mean_h_;  ///< semi-iterative scheme
  std::vector<IterationRecord> records_;
  double last_change_ = 0;  ///< absolute, W/m²
  double energy_defect_ = 0;
  bool finished_ = false, converged_ = false;
};

}  // namespace transillum
