// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// RadiositySolver solves with given directions in steps of a pass or an iteration. solve() is all
// of a solve in one call, SolveSession all of it in steps (solve_session.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/engine.h"
#include "transillum/export.h"
#include "transillum/first_shot.h"
#include "transillum/form_factors.h"
#include "transillum/linear_basis.h"
#include "transillum/patch_sums.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// The state of a solver.
struct SolveProgress {
  int iteration = 0;      ///< iterations finished
  int direction = 0;      ///< passes finished in the current iteration
  int passes = 0;         ///< passes of the current iteration: M, or fewer in Scheme::growing
  bool finished = false;  ///< converged, or all iterations done
  double change = 0;      ///< IterationRecord::change of the last finished iteration
  double seconds_transfers = 0;  ///< wall time of all passes so far
  double passes_per_second = 0;  ///< in the current iteration
  double seconds_left = 0;       ///< estimated time to the end of the current iteration
  Vec3 last_direction;           ///< omega of the last finished pass
  /// The work under way. With lobes (GlossySolver), these are scaled before the first iteration,
  /// and reflect in each after its passes.
  enum class Stage { passes, scaling_lobes, reflecting };
  Stage stage = Stage::passes;  ///< the present one
  double stage_fraction = 0;    ///< finished fraction of a stage of lobes, 0 to 1
  double lobes_per_second = 0;  ///< in a stage of lobes; one is a shape and orientation
};

/// The parts that a solver starts from. The solver makes each part that is null.
struct SolverResources {
  std::shared_ptr<const BspTree> tree = nullptr;  ///< the scene's tree
  /// Direct light of the scene's small sources, if SolveOptions::first_shot is set.
  std::shared_ptr<const DirectLight> shot = nullptr;
  /// Makes the passes, such as an engine that reads them from a file; null means
  /// SolveOptions::engine.
  TransferEngine engine = {};
  /// Where the sums over passes are kept; null keeps all of them in the memory of this process. Of
  /// several processes, each has a solver of its own with the same scene and options, and all call
  /// its functions that are not const, in the same order. The results have the same bits.
  std::shared_ptr<PatchSums> sums = nullptr;
};

/// Solves B_i = E_i + rho_i sum_j F_ij B_j (eq. 11, or 44 or 45 by its scheme) in steps that can be
/// observed and interrupted.
///
/// Threads: at most one thread at a time may call it. advance() distributes passes over
/// options().threads threads and sums them in a fixed order, so that the bits of the result do not
/// depend on the number of threads.
class RadiositySolver {
 public:
  /// Prepares a solve; makes no pass.
  /// @param scene the scene.
  /// @param options of the solve run.
  /// @param resources what the caller has already.
  /// @param cancellation checked here and in advance().
  /// @throws InputError, Canceled
  RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                  SolverResources resources = {}, const Cancellation& cancellation = {});
  ~RadiositySolver();
  /// The moved-from object may only be destroyed or assigned to.
  RadiositySolver(RadiositySolver&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  RadiositySolver& operator=(RadiositySolver&&) noexcept;

  /// Where a call of advance() returns.
  enum class Until {
    direction,  ///< after the next pass; after the next iteration if its passes are kept already
    iteration,  ///< after the next iteration
    finished,   ///< when the solve is finished
  };
  /// Called after every pass, in order, and after every iteration; on any thread, but never on two
  /// at once. It may read the solver and returns false to pause.
  using Observer = std::function<bool(const RadiositySolver&)>;

  /// Continues the solve. After a pause or an exception the solver is in the state after the last
  /// observed pass, from which the next call continues.
  /// @returns whether the solve is unfinished.
  /// @throws Canceled; NotConvergent, MemoryLimitExceeded (errors.h).
  /// Where several processes solve, all pause after the same pass if an observer returns false in
  /// one; observers see the progress, but B only after complete_estimate().
  bool advance(Until until, const Observer& observer = {});
  /// Makes what the solver returns complete within an observer's call, as it is between calls of
  /// advance(). To be called in all processes after the same pass; one process alone need not.
  void complete_estimate() const;

  /// The scene.
  const Scene& scene() const;
  /// The scene, shared.
  std::shared_ptr<const Scene> shared_scene() const;
  /// The scene's BSP tree.
  const BspTree& tree() const;
  /// The BSP tree, shared.
  std::shared_ptr<const BspTree> shared_tree() const;
  /// The options it was constructed with.
  const SolveOptions& options() const;
  /// The first shot; all 0 if there is none.
  std::shared_ptr<const DirectLight> direct_light() const;
  /// The current state.
  SolveProgress progress() const;
  /// omega of each pass of an iteration, in the order of the passes.
  const std::vector<Vec3>& directions() const;
  /// Statistics of the run so far.
  SolveStatistics statistics() const;

  /// B of the last finished iteration, W/m², one per patch; before the first: E, plus the
  /// contribution of the first shot. With Basis::linear, the mean of B over the patch.
  const std::vector<Rgb>& radiosity() const;
  /// The linear terms of the radiosity that solution() returns, one per patch; empty with
  /// Basis::constant.
  std::vector<LinearTerm> linear_terms() const;
  /// B of the current iteration, W/m², estimated from the passes done so far; radiosity() between
  /// iterations.
  std::vector<Rgb> running_estimate() const;
  /// H of the last finished iteration, W/m², one per patch; with Basis::linear, the mean of H over
  /// the patch.
  const std::vector<Rgb>& irradiance() const;
  /// Keeps form factors in the semi-iterative scheme too, from the next pass on. The other schemes
  /// always keep them if SolveOptions::memory suffices.
  void keep_form_factors();
  /// Adds one replica, with as many directions as the last, and continues a finished solve:
  /// options().directions and options().replicas increase. radiosity() remains until the next
  /// iteration is finished.
  /// @throws std::logic_error unless the solve is finished, its scheme is fixed or
  /// conjugate_gradients, and it has at least 2 replicas.
  void add_replica();
  /// Writes the state: all that passes and iterations have led to. An observer may call it.
  /// Where several processes solve, all must call it after the same pass; the first writes the
  /// state of all, in the format of one.
  /// @param out binary; its errors are left to the caller.
  void save(std::ostream& out) const;
  /// Sets the state to one that save() wrote in the same version of the library, from a solver with
  /// the same scene and options; the number of threads may differ. The solve then continues to the
  /// same bits. To be called before advance().
  /// Where several processes solve, all must call it, each with the whole state, and then
  /// complete_estimate().
  /// @param in binary.
  /// @param size length of the state, bytes.
  /// @throws std::runtime_error where it is damaged or of another scene; the solver may then only
  /// be destroyed.
  void restore(std::istream& in, std::uint64_t size);
  /// F_ij of all pairs, from the kept exchange sums of all passes; in the semi-iterative scheme, of
  /// all iterations. With Basis::linear, F_ij of constant functions, which alone do not give its B.
  /// @throws std::runtime_error where no iteration is finished or one is unfinished, or where they
  /// were not kept or exceed the memory limit. Where several processes solve, all must call it;
  /// the first gets the form factors, the others empty rows.
  FormFactors form_factors() const;
  /// sum_j F_ij, one per patch, from the passes done so far; 1 within eps(M)/pi where i is
  /// enclosed.
  std::vector<double> form_factor_sums() const;
  /// Per patch: fraction of the light leaving it that escapes, meeting no patch; from the passes
  /// done so far, with the weights of form_factor_sums(). Where no backs are seen, both sum to 1
  /// (eq. 17).
  std::vector<double> sky_fractions() const;
  /// Per patch: what it receives from SolveOptions::sky and its sun, W/m², from the passes done so
  /// far; empty without a sky. In the semi-iterative scheme, for the last set of directions.
  std::vector<Rgb> sky_irradiance() const;
  /// Linear parts of sky_irradiance(), W/m²; empty without a sky, and with Basis::constant.
  std::vector<LinearTerm> sky_linear_terms() const;
  /// Per patch: fraction of its visible area of which receivers see the back side, over all passes
  /// so far.
  std::vector<double> back_seen_fractions() const;
  /// The error estimate from replicas: for radiosity(), or within an iteration for
  /// running_estimate().
  ErrorEstimate error_estimate() const;
  /// The result so far: within an iteration the running estimate, else radiosity(); complete once
  /// the solve has finished. In its statistics, seconds_load is 0 and seconds_total is the sum of
  /// the solver's own times, which a caller that measures them may replace.
  Solution solution() const;
  /// omega of a pass of any iteration.
  /// @param iteration from 0.
  /// @param pass from 0; less than the number of passes of that iteration.
  Vec3 direction(int iteration, int pass) const;
  /// omega of the passes of any iteration, as directions().
  /// @param iteration from 0.
  std::vector<Vec3> directions_of(int iteration) const;
  /// Number of passes of any iteration, including those whose exchanges are kept.
  /// @param iteration from 0.
  int passes_of(int iteration) const;
  /// Per pass of the current iteration: largest change of the running estimate by that pass, over
  /// its largest reflected light. Empty between iterations.
  const std::vector<double>& estimate_changes() const;
  /// eps after each pass so far: the largest magnitude of eq. 17 over the patches, which eq. 21
  /// bounds. In the semi-iterative scheme, only for the current set of directions.
  const std::vector<double>& quadrature_errors() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace TRANSILLUM_API transillum
