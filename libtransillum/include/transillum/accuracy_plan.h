// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Solving to an accuracy: stages of a RadiositySolver with more and more directions, each split
// into rotated replicas, until the error that they show is below the goal
// (decisions/0052-accuracy.md).
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <vector>

#include "transillum/export.h"
#include "transillum/radiosity.h"

namespace TRANSILLUM_API transillum {

/// The relative error that `goal` is about: its limit with 95 % confidence.
/// @param scene the scene.
/// @param b radiosity, W/m², one per patch.
/// @param error the error estimate of `b`.
/// @returns infinity without an estimate; 0 where B is 0.
/// @throws InputError where the scene does not have the goal's patch.
double error_for(const AccuracyGoal& goal, const Scene& scene, const std::vector<Rgb>& b,
                 const ErrorEstimate& error);

/// The patches whose standard errors may be much too small: all replicas miss light alike that
/// comes to them from a small source. Not measured but expected, by sizes and distances: light of
/// sources that fewer than least_light_directions per replica bring to the patch is more than half
/// of its interval. What stands between is not counted, so these may be too many.
/// @param solution of passes with replicas; otherwise, and where all sources were shot first or
/// patches times sources exceed 2^22, the result is empty.
std::vector<PatchId> uncertain_patches(const Solution& solution);

/// Chooses the stages of a solve with SolveOptions::goal. The caller makes each: a new
/// RadiositySolver with stage(), or RadiositySolver::add_replica() of the last.
///
/// The first stage has few directions. Each further one has as many as are expected to suffice, by
/// the error of those before; where only little is missing, a replica more. Earlier stages are
/// discarded, so that the result is that of the last stage alone. Not thread-safe.
class AccuracyPlan {
 public:
  /// @param options with a goal; validated. If it has replicas, the first stage is its own
  /// `directions` and `replicas`: a solve continues where another has ended.
  /// @param scene the scene.
  /// @throws InputError
  AccuracyPlan(const SolveOptions& options, const Scene& scene);

  /// Options of the stage to be solved.
  const SolveOptions& stage() const { return stage_; }
  /// What comes after a stage.
  enum class Next {
    done,     ///< the goal is reached, or cannot be
    stage,    ///< a new solver with stage()
    replica,  ///< add_replica(), then the solver again
  };
  /// To be called when the solver of a stage has finished.
  /// @param solver the solver.
  /// @param seconds wall time since the start of the solve.
  Next next(const RadiositySolver& solver, double seconds);
  /// To be called where the solver of a stage throws NotConvergent: its directions are too few for
  /// the scene's reflectance.
  /// @returns whether stage() now has more; false where so many should converge.
  bool enlarge();
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

  Next grow(double factor, double seconds_per_pass, double seconds_left);
  double growth() const;
  bool is_stalled() const;

  AccuracyReport report_;
  SolveOptions stage_;
  double light_directions_ = 0;     ///< per replica, in the last stage
  double seconds_ = 0;              ///< at the end of the last stage
  std::int64_t passes_before_ = 0;  ///< made by the solver of the stage, before its last passes
};

/// Number of passes that a goal is expected to take, for decisions made before the first; M without
/// a goal.
int expected_directions(const SolveOptions& options);

/// A solve to an accuracy that is under way: the plan, and the solver of its stage.
struct AccuracyRun {
  AccuracyPlan plan;       ///< with the stages that are finished
  RadiositySolver solver;  ///< of plan.stage()
};
/// Called as RadiositySolver::Observer, with the plan so far; and once more where the solve is
/// canceled.
using AccuracyObserver = std::function<bool(const RadiositySolver&, const AccuracyPlan&)>;

/// Solves to `options.goal`.
/// @param scene the scene.
/// @param options with a goal.
/// @param tree, shot as for RadiositySolver.
/// @param observer as for RadiositySolver::advance(); sees the solvers of all stages. Returning
/// false ends the solve.
/// @param cancellation checked throughout.
/// @param seconds wall time spent before, which counts as used.
/// @param run goes on with that instead of the first stage.
/// @param group as for RadiositySolver; the time of its member 0 decides.
/// @returns the last stage that was finished, with its report; complete unless canceled or ended by
/// the observer. If that happens in the first stage: its estimate so far.
/// @throws InputError; Canceled before the first pass; NotConvergent, std::runtime_error
Solution solve_to_accuracy(const std::shared_ptr<const Scene>& scene, const SolveOptions& options,
                           std::shared_ptr<const BspTree> tree = nullptr,
                           std::shared_ptr<const DirectLight> shot = nullptr,
                           const AccuracyObserver& observer = {},
                           const Cancellation& cancellation = {}, double seconds = 0,
                           std::optional<AccuracyRun> run = {},
                           const std::shared_ptr<SolverGroup>& group = nullptr);

}  // namespace TRANSILLUM_API transillum
