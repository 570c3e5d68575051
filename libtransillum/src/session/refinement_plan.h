// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/refinement.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum {

/// The rounds of a refinement. Each round: the caller solves scene(), then assess(), then
/// divide_worst(). Not thread-safe.
class RefinementPlan {
 public:
  /// @param scene to start from.
  /// @param options of the solves. Engines that make no passes are refused.
  /// @param refine criterion and limits.
  /// @param cancellation checked while patches are divided.
  /// @throws InputError, Canceled
  RefinementPlan(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                 const RefineOptions& refine, const Cancellation& cancellation = {});

  /// Whether no round is left: scene() is the refined one.
  bool finished() const { return finished_; }
  /// The next scene to solve. By RefineBy::error, in a round, refined() with all patches divided.
  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  /// The scene so far.
  const std::shared_ptr<const Scene>& refined() const { return refined_; }
  /// Criterion and limits.
  const RefineOptions& options() const { return refine_; }
  /// The divisions that make scene() from the scene to start from: SceneInput::divided.
  std::vector<std::string> divisions() const;
  /// The finished rounds, in order.
  const std::vector<RefinementRound>& rounds() const { return rounds_; }

  /// Adds a round, unless finished().
  /// @param solution of scene(), complete.
  /// @param seconds wall time that it took.
  /// @param cancellation checked throughout.
  /// @throws Canceled
  const RefinementRound& assess(const Solution& solution, double seconds,
                                const Cancellation& cancellation = {});
  /// Divides the patches that are worst by the last assess().
  /// @returns whether there is another round
  /// @throws InputError where another does not fit into memory; Canceled
  bool divide_worst(const Cancellation& cancellation = {});

 private:
  void begin_round(const Cancellation& cancellation);
  void finish();

  SolveOptions options_;
  RefineOptions refine_;
  std::shared_ptr<const Scene> refined_, scene_;
  std::vector<PatchId> parent_;  ///< DividedScene::parent of scene_, by RefineBy::error
  std::vector<double> squares_;  ///< per patch of refined_, of the last assess()
  double seconds_ = 0;           ///< time of dividing, before the solve
  bool finished_ = false;
  std::vector<RefinementRound> rounds_;
  std::vector<std::string> divisions_;  ///< the divisions that make refined_
};

}  // namespace transillum
