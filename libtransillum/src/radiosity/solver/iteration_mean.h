// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "radiosity/error/batch_means.h"
#include "radiosity/reflected_light.h"
#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/running_mean.h"
#include "radiosity/solver/start_remainder.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum {

/// The mean over iterations of the semi-iterative scheme (eq. 45), when it begins, and its error.
class IterationMean {
 public:
  /// @param light of the scene
  IterationMean(const SolveOptions& options, ReflectedLight light)
      : options_(options), light_(std::move(light)) {
    check_burn_in();
  }

  int count() const { return b_.count; }    ///< iterations in the mean
  int burn_in() const { return burn_in_; }  ///< iterations before it, so far
  bool begins() const { return past_; }     ///< whether the iteration under way counts in it
  std::vector<Rgb> b() const { return b_.mean(); }  ///< W/m²
  std::vector<Rgb> h() const { return h_.mean(); }  ///< W/m²
  /// The value of b()[i] if the iteration under way ends with B_i = `value`.
  Rgb with(std::size_t i, const Rgb& value) const;
  /// Upper bound of what the solution exceeds b() by, because of the start, W/m², one per patch.
  std::vector<Rgb> left() const;
  /// IterationRecord::error, if known.
  std::optional<double> error(const StartRemainder& start) const;

  /// Adds an iteration that ended with `iterate`, or ends the burn-in by it.
  /// @param before B of the iteration before; not used once the burn-in has ended
  void add(const RadiosityIterate& iterate, const std::vector<Rgb>& before,
           const StartRemainder& start);

  /// For StateOutput and StateInput.
  /// @param patches of the scene
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self, std::size_t patches) {
    archive(self.burn_in_, self.past_);
    for (auto* mean : {&self.b_, &self.h_, &self.left_}) {
      RunningMean::visit_state(archive, *mean, patches);
    }
    BatchMeans::visit_state(archive, self.batches_, patches);
  }

 private:
  void check_burn_in();
  bool start_is_forgotten(const RadiosityIterate& iterate, const std::vector<Rgb>& before,
                          const StartRemainder& start) const;

  SolveOptions options_;
  ReflectedLight light_;
  int burn_in_ = 0;
  bool past_ = false;
  RunningMean b_, h_, left_;
  BatchMeans batches_;
};

}  // namespace transillum
