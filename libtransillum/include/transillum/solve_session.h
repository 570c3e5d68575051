// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// A solve from beginning to end: rounds of refinement, stages of an accuracy, iterations and
// passes, diffuse or with lobes. solve() and refine() are the same in one call.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "transillum/accuracy_goal.h"
#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/engine.h"
#include "transillum/export.h"
#include "transillum/glossy.h"
#include "transillum/patch_sums.h"
#include "transillum/radiosity_solver.h"
#include "transillum/refinement.h"
#include "transillum/scene.h"
#include "transillum/solution.h"
#include "transillum/solve_options.h"

namespace TRANSILLUM_API transillum {

/// The work before the first pass of a solve.
enum class Preparation { tree, first_shot };

/// The scene, the options and the ready-made parts of a solve.
struct SolveRequest {
  std::shared_ptr<const Scene> scene;                 ///< has the materials to solve for
  SolveOptions options = {};                          ///< options of each solve
  std::optional<RefineOptions> refine = {};           ///< options of preceding rounds, if any
  std::shared_ptr<const BspTree> tree = nullptr;      ///< tree of `scene`; built if null
  std::shared_ptr<const DirectLight> shot = nullptr;  ///< direct light of `scene`; shot if null
  TransferEngine engine = {};                         ///< makes the passes; options.engine if null
  std::shared_ptr<PatchSums> sums = nullptr;          ///< SolverResources::sums
  bool keep_form_factors = false;  ///< calls RadiositySolver::keep_form_factors()
  /// Called with the finished fraction of a preparation, 0 to 1, on any thread, one at a time.
  std::function<void(Preparation, double)> preparing = {};
};

/// A solve that can be observed, paused, saved (Checkpoint) and continued.
///
/// Without a goal and without rounds it has one stage. With SolveOptions::goal, each stage has more
/// directions or replicas than the one before, until the error that the replicas show is below the
/// goal (decisions/0052-accuracy.md); the result comes from the last stage that has finished. With
/// rounds of refinement, each round is such a solve, and the refined scene is solved last.
///
/// Threads: at most one thread at a time may call it; an observer may read it.
class SolveSession {
 public:
  /// Checks the options; prepare() and advance() do the work.
  /// @param request scene and options. Engines that make no passes are refused.
  /// @param cancellation checked here and in all functions that are not const.
  /// @throws InputError, Canceled
  explicit SolveSession(SolveRequest request, const Cancellation& cancellation = {});
  ~SolveSession();
  /// The moved-from object may only be destroyed or assigned to.
  SolveSession(SolveSession&&) noexcept;
  /// The moved-from object may only be destroyed or assigned to.
  SolveSession& operator=(SolveSession&&) noexcept;

  /// Makes what the passes of the next stage start from: the tree, the first shot, the solver.
  /// advance() does it where it was not called. If it fails, it may be called again.
  /// @throws InputError, Canceled, std::runtime_error where there is too little memory. Of
  /// several processes all must call it.
  void prepare();
  /// The same, where it may be interrupted and called again.
  /// @param interruption checked in place of the cancellation of the session, which ends it for
  /// good.
  /// @throws Canceled, and as above
  void prepare(const Cancellation& interruption);
  /// Whether prepare() has been called for the present stage: the functions below that return what
  /// the solver has require it.
  bool is_prepared() const;

  /// Where a call of advance() returns.
  enum class Until {
    direction,  ///< after the next pass; after the next iteration if its passes are kept already
    iteration,  ///< after the next iteration
    stage,      ///< when a stage has ended; the next one is not prepared yet
    finished,   ///< when the solve is finished
  };
  /// Called after every pass, in order, and after every iteration; with lobes after batches of
  /// passes, and while lobes are scaled or reflect. On any thread, but never on two at once. It may
  /// read the session and returns false to pause.
  using Observer = std::function<bool(const SolveSession&)>;

  /// Continues the solve. After a pause or an exception the session is in the state after the last
  /// observed pass, from which the next call continues.
  /// @returns whether the solve is unfinished.
  /// @throws Canceled; NotConvergent, MemoryLimitExceeded (errors.h); as prepare()
  bool advance(Until until, const Observer& observer = {});
  /// Continues through all rounds, and then until passes_done() is `passes` or the stage has ended.
  /// @param passes to be made after the last round.
  /// @param observer the same as for advance().
  /// @returns whether the solve is unfinished.
  /// @throws the exceptions of advance()
  bool advance_to(std::int64_t passes, const Observer& observer = {});

  /// Replaces the materials of a solve with lobes and starts to iterate again from the present
  /// light, with the transfers that are kept: GlossySolver::set_materials().
  /// @throws std::logic_error where no lobes take part; as GlossySolver::set_materials()
  void relight(const std::vector<Material>& materials,
               const std::vector<std::int32_t>& of_patch = {});

  /// Whether solution() has more than the emission: a pass was made, or a stage of a goal has
  /// ended.
  bool has_result() const;
  /// Whether the solve is finished.
  bool finished() const;
  /// The scene of the present round.
  const std::shared_ptr<const Scene>& scene() const;
  /// The BSP tree of scene(); null before prepare().
  const std::shared_ptr<const BspTree>& tree() const;
  /// Where sums over passes are kept; never null.
  const std::shared_ptr<PatchSums>& sums() const;
  /// Whether a round of refinement follows the present solve.
  bool in_rounds() const;
  /// The rounds that are finished.
  const std::vector<RefinementRound>& rounds() const;
  /// The scene as refined so far: scene(), or, in a round by RefineBy::error, the scene before each
  /// patch was divided.
  const std::shared_ptr<const Scene>& refined_scene() const;
  /// The divisions that make scene() from the scene of the request: SceneInput::divided. Solved
  /// with them, that scene has the same patches.
  std::vector<std::string> divisions() const;
  /// The finished stages of a solve with a goal, and whether the last reached it; nothing without
  /// a goal.
  std::optional<AccuracyReport> accuracy() const;
  /// Wall time of the present round in functions of this session, and of the session that saved it,
  /// s.
  double seconds() const;

  /// The solver of the present stage; null where lobes take part.
  const RadiositySolver* diffuse() const;
  /// The solver where lobes take part, else null.
  const GlossySolver* glossy() const;
  /// The options of the present stage: with a goal, each has its own number of directions.
  const SolveOptions& options() const;
  /// The state of the present stage.
  SolveProgress progress() const;
  /// Passes of the present stage, of all iterations.
  std::int64_t passes_done() const;
  /// Statistics of the present stage.
  SolveStatistics statistics() const;
  /// omega of each pass of the newest iteration.
  const std::vector<Vec3>& directions() const;
  /// omega of the passes of any iteration of the present stage.
  std::vector<Vec3> directions_of(int iteration) const;
  /// Number of passes of any iteration of the present stage.
  int passes_of(int iteration) const;
  /// B of the last finished iteration, W/m², one per patch.
  std::vector<Rgb> radiosity() const;
  /// RadiositySolver::running_estimate(); with lobes radiosity().
  std::vector<Rgb> running_estimate() const;
  /// RadiositySolver::linear_terms(); empty with lobes.
  std::vector<LinearTerm> linear_terms() const;
  /// RadiositySolver::estimate_changes(); empty with lobes.
  std::vector<double> estimate_changes() const;
  /// RadiositySolver::error_estimate(), or GlossySolver's.
  ErrorEstimate error_estimate() const;
  /// The result so far: with a goal, of the last finished stage, if there is one. Complete once the
  /// solve has finished.
  Solution solution() const;

 private:
  friend class Checkpoint;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Solves in one call. If `cancellation` is set during the passes, it returns the best estimate so
/// far, with complete = false.
/// @param scene the scene.
/// @param options of the solve run.
/// @param observer as for SolveSession::advance(); returning false ends the solve.
/// @param cancellation checked throughout.
/// @param sums as for RadiositySolver.
/// @throws InputError; Canceled before the first pass; NotConvergent, std::runtime_error
Solution solve(std::shared_ptr<const Scene> scene, const SolveOptions& options,
               const SolveSession::Observer& observer = {}, const Cancellation& cancellation = {},
               const std::shared_ptr<PatchSums>& sums = nullptr);

/// A refined scene and how it was reached.
struct Refinement {
  std::shared_ptr<const Scene> scene;   ///< to be solved by the caller
  std::vector<RefinementRound> rounds;  ///< in order; by RefineBy::error the last is of `scene`
};

/// Refines a scene in rounds: each solves it and divides the patches that are worst, until the
/// number of patches or the measure is reached, or nothing is left to divide. The number of patches
/// at most doubles in a round, so that each decision is made by a solve that can see it.
/// @param scene to start from.
/// @param options of the solves. Engines that make no passes are refused.
/// @param refine criterion and limits.
/// @param observer of the solves; returning false ends the refinement.
/// @throws InputError, Canceled; exceptions of solve()
Refinement refine(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                  const RefineOptions& refine, const SolveSession::Observer& observer = {},
                  const Cancellation& cancellation = {});

}  // namespace TRANSILLUM_API transillum
