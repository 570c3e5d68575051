// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <vector>

#include "radiosity/reflected_light.h"
#include "radiosity/solver/iteration_mean.h"
#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/solver_input.h"
#include "radiosity/solver/start_remainder.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum {

/// The finished iterations: their records, B and H they lead to, and whether the solve is done.
///
/// B and H of the last iteration; in the semi-iterative scheme after the burn-in, the mean
/// over the iterations since (eq. 45).
class IterationHistory {
 public:
  /// Keeps references to parts of `input`.
  /// @param first B before any iteration
  IterationHistory(const SolverInput& input, const RadiosityIterate& first);

  int size() const { return static_cast<int>(records_.size()); }
  const std::vector<IterationRecord>& records() const { return records_; }
  const std::vector<Rgb>& b() const { return b_; }  ///< values of all unknowns, W/m²
  const std::vector<Rgb>& h() const { return h_; }  ///< irradiance of all unknowns, W/m²
  /// Values of patches: the means of a linear basis, W/m².
  const std::vector<Rgb>& patch_b() const { return unknowns_.per_patch == 1 ? b_ : mean_b_; }
  const std::vector<Rgb>& patch_h() const { return unknowns_.per_patch == 1 ? h_ : mean_h_; }
  bool finished() const { return finished_; }  ///< no iteration is left to do
  bool converged() const { return converged_; }

  /// Whether b() is a mean over iterations, and the iterations before those in the mean, so far.
  bool averaged() const { return mean_.count() > 0; }
  int burn_in() const { return mean_.burn_in(); }
  /// Whether the iteration under way will count in the mean.
  bool past_burn_in() const { return semi_iterative() && mean_.begins(); }
  /// The value of b()[i] if the iteration under way ends with `value`.
  Rgb with(std::size_t i, const Rgb& value) const;
  /// Bound of what b() is off by because the iteration has ended, converged or not: W/m², one per
  /// unknown; empty before the first iteration. Of the semi-iterative scheme what is left of the
  /// start.
  std::vector<Rgb> left() const;

  /// The rest of the start; it gathers along the same passes.
  StartRemainder& start() { return start_; }
  /// Sets B and H after an iteration that ended with `iterate`, records it and applies the stopping
  /// rule: of the light not yet propagated, or of the error of the mean.
  /// @param changes of iterate.b(), W/m²
  /// @param seconds wall time of the iteration
  /// @param complete whether the iteration used all M directions
  /// @throws NotConvergent where changes have grown for several iterations
  void update(const RadiosityIterate& iterate, const std::vector<Rgb>& changes, double seconds,
              bool complete);
  /// Continues after the end, because the set of directions has grown: the stopping rule counts
  /// iterations from here.
  void reopen(int directions);
  /// Iterations finished since reopen().
  int size_since_reopening() const { return size() - reopened_at_; }

  /// For StateOutput and StateInput.
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self) {
    archive.fixed(self.b_, self.h_);
    IterationMean::visit_state(archive, self.mean_, self.b_.size());
    auto entries = static_cast<std::uint64_t>(self.size());
    archive(self.start_, entries);
    if constexpr (Archive::reading) {
      archive.require(entries <= most_records);
      self.records_.resize(static_cast<std::size_t>(entries));
    }
    for (auto& record : self.records_) {
      archive(record.change, record.contraction, record.seconds, record.error, record.remainder,
              record.remainder_dimmest, record.unlit_area, record.change_of_b, record.changes);
    }
    archive(self.last_change_, self.changed_power_, self.left_to_do_, self.reopened_at_,
            self.finished_, self.converged_, self.options_.directions);
    archive.require(self.reopened_at_ >= 0 && self.reopened_at_ <= self.size());
    if constexpr (Archive::reading) {
      self.set_means();
    }
  }

 private:
  static constexpr std::uint64_t most_records = 1'000'000;  ///< SolveOptions::iterations
  void set_means();
  bool semi_iterative() const { return traits_of(options_.scheme).renews_directions; }
  /// Bound on the factor by which an iteration reduces the distance of B to its limit.
  double contraction() const;
  bool reached_tolerance() const;
  /// One per patch, W/m²; empty without a sky.
  std::vector<Rgb> sky_irradiance(const RadiosityIterate& iterate) const;
  void stop(bool complete);
  /// rho times the row sums of F is above 1 where there are too few directions.
  void check_contraction() const;

  const Unknowns& unknowns_;
  SolveOptions options_;
  RemainderBound remainder_;
  std::vector<Rgb> b_, h_;
  std::vector<Rgb> mean_b_, mean_h_;  ///< means of patches; empty where they are the unknowns
  IterationMean mean_;                ///< semi-iterative scheme
  StartRemainder start_;              ///< semi-iterative scheme
  std::vector<IterationRecord> records_;
  double last_change_ = 0;            ///< absolute, W/m²
  double changed_power_ = 0;          ///< by the last iteration, over the emitted power
  std::optional<double> left_to_do_;  ///< semi-iterative scheme: compared with the tolerance
  int reopened_at_ = 0;               ///< size() at reopen()
  bool finished_ = false, converged_ = false;
};

}  // namespace transillum
