// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solving to an accuracy: which stages are made, with more and more directions, each split into
// rotated replicas, until the error that they show is below the goal (decisions/0052-accuracy.md).
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

#include "radiosity/error/error_estimate.h"
#include "session/shot_points.h"
#include "session/stage_errors.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace transillum {

/// Chooses the stages of a solve with SolveOptions::goal. The caller makes each: a new solver with
/// stage(), or RadiositySolver::add_replica() of the last. With lobes all are new solvers.
///
/// The first stage has few directions. Each further one has as many as are expected to suffice, by
/// the error of those before; where only little is missing, a replica more. Earlier stages are
/// discarded, so that the result comes from the last stage alone. Not thread-safe.
class AccuracyPlan {
 public:
  /// @param options with a goal; validated. If it has replicas, the first stage is its own
  /// `directions` and `replicas`: a solve continues where another has ended.
  /// @param scene the scene.
  /// @throws InputError
  AccuracyPlan(const SolveOptions& options, const Scene& scene);

  /// Options of the stage to be solved.
  const SolveOptions& stage() const { return stage_; }
  /// DirectLight::points that the first shot should have; empty: as many as the options say.
  const std::vector<int>& shot_points() const { return shot_points_.of_patches(); }
  /// The next work after a stage.
  enum class Next {
    done,     ///< the goal is reached, or cannot be
    stage,    ///< a new solver with stage()
    replica,  ///< add_replica(), then the solver again
  };
  /// To be called when the solver of a stage has finished.
  /// @param result of the stage.
  /// @param seconds wall time since the start of the solve.
  Next next(const StageResult& result, double seconds);
  /// To be called where the solver of a stage throws NotConvergent: its directions are too few for
  /// the scene's reflectance.
  /// @returns whether stage() now has more; false where so many should converge.
  bool enlarge();
  /// To be called where the time ends within a stage, which is discarded.
  void end_late() { report_.obstacle = AccuracyObstacle::seconds; }
  /// The stages so far and whether the last reached the goal.
  const AccuracyReport& report() const { return report_; }

  /// Writes the state.
  /// @param out binary; its errors are left to the caller.
  void save(std::ostream& out) const;
  /// Sets the state to one that save() wrote in the same version of the library, from a plan with
  /// the same options and scene. To be called before next().
  /// @param in binary.
  /// @param size length of the state, bytes.
  /// @throws std::runtime_error where it is damaged
  void restore(std::istream& in, std::uint64_t size);

 private:
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self);

  Next end(AccuracyObstacle obstacle);
  Next again();
  bool asks_for_iterations(const StageResult& result);
  std::optional<Next> refine_shot(const StageResult& result, double seconds_left);
  Next grow(double factor, double by_time, double by_memory);
  double growth() const;
  bool is_stalled() const;
  /// Passes that the goal still allows.
  double passes_left() const;

  ErrorSurfaces surfaces_;
  AccuracyReport report_;
  SolveOptions stage_;
  ShotPoints shot_points_;
  double light_directions_ = 0;     ///< per replica, in the last stage
  double seconds_ = 0;              ///< at the end of the last stage, without preparation
  std::int64_t passes_before_ = 0;  ///< made by the solver of the stage, before its last passes
};

}  // namespace transillum
