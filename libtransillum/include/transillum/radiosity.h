// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Options and result of a solve, plain structs, and RadiositySolver, which makes one with given
// directions in steps of a pass or an iteration. solve() is all of it in one call, SolveSession all
// of it in steps (solve_session.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/accuracy_goal.h"
#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/choice.h"
#include "transillum/directions.h"
#include "transillum/engine.h"
#include "transillum/export.h"
#include "transillum/first_shot.h"
#include "transillum/form_factors.h"
#include "transillum/linear_basis.h"
#include "transillum/patch_sums.h"
#include "transillum/scene.h"
#include "transillum/sky.h"
#include "transillum/transfers.h"

namespace TRANSILLUM_API transillum {

/// How the form-factor matrix is scaled to have the correct row sums.
enum class Normalization {
  none,       ///< the paper's plain estimator
  rows,       ///< rows divided by their quadrature of the cosine: removes the error of section 5.1;
              ///< the iteration contracts for every M; reciprocity is lost
  symmetric,  ///< rows and columns scaled by the same factors to the same end: reciprocity,
              ///< A_i F_ij = A_j F_ji, is kept. Requires two_way and kept form factors
};
/// Their names (choice.h).
template <>
const Choices& choices_of<Normalization>();

/// Which directions an iteration uses, and how iterations are combined (section 6).
enum class Scheme {
  fixed,           ///< the same M directions in every iteration (eq. 11)
  growing,         ///< twice as many in each iteration, up to M; each computed once (eq. 44)
  semi_iterative,  ///< M new directions in each iteration; B is the mean over iterations (eq. 45)
  conjugate_gradients,  ///< the equations of `fixed` in symmetric form, solved by conjugate
                        ///< gradients to within the tolerance of the limit of the iteration, in
                        ///< the second iteration. Requires two_way; not with Normalization::rows
};
/// Their names (choice.h).
template <>
const Choices& choices_of<Scheme>();

/// The properties of a scheme. Callers ask these instead of naming schemes.
struct SchemeTraits {
  Scheme value;                    ///< which one
  const char* name;                ///< in options and files
  const char* label;               ///< in a list of choices
  const char* sentence;            ///< which directions an iteration has
  bool renews_directions = false;  ///< each iteration has other directions; B is their mean
  bool is_symmetric = false;       ///< solves the equations in symmetric form
};
/// The traits of one scheme.
const SchemeTraits& traits_of(Scheme scheme);

/// The functions that represent the radiosity of a patch.
enum class Basis {
  constant,  ///< one value per patch
  linear,    ///< a linear function on each patch (section 3; ALGORITHM.md 6.12), not continuous
             ///< across edges. Requires an engine that has_moments(), or pairs; not with
             ///< Normalization::symmetric, Scheme::semi_iterative or a first shot
};
/// Their names (choice.h).
template <>
const Choices& choices_of<Basis>();

/// Options of a solve run.
struct SolveOptions {
  int directions = 1024;                          ///< M: passes per iteration, 1 … 2^24
  std::optional<Sampling> sampling = {};          ///< set of directions; unset: used_sampling()
  std::uint64_t seed = 1;                         ///< of seeded samplings and of engine rays
  std::optional<std::uint64_t> rotation = {};     ///< seed of a rotation of all directions, if any
  Engine engine = Engine::fast;                   ///< computes the transfers
  EngineOptions engine_options = {};              ///< of the engine
  bool two_way = true;                            ///< each pass serves omega and -omega
  Normalization normalize = Normalization::none;  ///< of the form factors
  Scheme scheme = Scheme::fixed;                  ///< of the iteration
  Basis basis = Basis::constant;                  ///< of the radiosity on a patch
  /// R²/A from which sources are small and, if bright, are shot before the first iteration, or
  /// first_shot_where_it_pays (first_shot_sources()); nothing: no first shot.
  std::optional<double> first_shot = {};
  /// semi_iterative: iterations omitted from the mean; unset: until what is left of the start is
  /// below a quarter of the RMS change per iteration, or a tenth of the tolerance; at most half of
  /// `iterations`
  std::optional<int> burn_in = {};
  int replicas = 1;    ///< 2 … 64: split the M directions into this many sets with independent
                       ///< rotations, whose spread gives an error estimate. At most M
  int iterations = 0;  ///< number of iterations; 0: by averaged_iterations or tolerance
  /// semi_iterative: number of iterations in the mean, after which it stops; 0: by tolerance
  int averaged_iterations = 0;
  /// Bound of what the iteration leaves out, relative to reflected light: of
  /// IterationRecord::remainder and remainder_dimmest; semi_iterative: IterationRecord::error
  double tolerance = 1e-6;
  std::uint64_t memory = 0;  ///< limit for kept form factors, bytes; 0: a quarter of the machine's
  int threads = 0;           ///< 0: all cores; the result does not depend on it
  /// If set, a SolveSession chooses `directions` and `replicas`. A RadiositySolver uses
  /// those given.
  AccuracyGoal goal = {};
  /// Light that enters where nothing is above a patch. Not with engines hemicube and pairs.
  Sky sky = {};
  /// solve(): lobes of materials take part (glossy.h). Requires two_way, Scheme::fixed,
  /// Basis::constant, 1 replica, an engine that takes_directions(), normalization none or rows; no
  /// first shot, no goal. A RadiositySolver leaves lobes out.
  bool glossy = false;

  /// `sampling`, or default_sampling(two_way).
  Sampling used_sampling() const { return sampling.value_or(default_sampling(two_way)); }
  /// @throws InputError naming the option and its range.
  void validate() const;
  /// Exact comparison of all members.
  friend bool operator==(const SolveOptions&, const SolveOptions&) = default;
};

/// One finished iteration of eq. 11.
struct IterationRecord {
  /// Largest change of B over the largest reflected light (reflected_light()); not of the mean
  double change = 0;
  double contraction = 0;  ///< absolute change over that of the iteration before; 0 in the first.
                           ///< semi_iterative: factor per iteration by which the influence of the
                           ///< start decreases
  double seconds = 0;      ///< wall time
  /// semi_iterative, from the eighth iteration in the mean on: largest error of the mean over its
  /// largest reflected light: 95 % of the spread of iterations, and all that is left of the start.
  /// The sets of directions must differ: Sampling::hammersley and centered_hammersley have the
  /// error of one set.
  std::optional<double> error = {};
  /// Bound of the power that further iterations would add, over the reflected power, in the channel
  /// where it is largest. With c the larger of rho_max and the contraction, it is c / (1 - c) times
  /// the power of the last change; infinite where c is not below 1. semi_iterative: bound of what
  /// is left of the start
  double remainder = 0;
  /// The same of the dimmest tenth of the area that is lit: B - E is at least 1e-6 of the largest.
  double remainder_dimmest = 0;
  double unlit_area = 0;   ///< share of the area of reflecting patches that is not lit
  double change_of_b = 0;  ///< eq. 25 of the paper: largest change of B over the largest B, with E
};

/// A solve of an adaptive refinement (refinement.h), after which patches are divided.
struct RefinementRound {
  std::int64_t patches = 0;  ///< of the scene so far
  /// Root of the sum of squares over patches, relative to that of the radiosity of all patches that
  /// emit nothing: by RefineBy::jump of the jump times the root of the area, by RefineBy::error of
  /// what the functions of a patch cannot represent
  double figure = 0;
  double seconds = 0;  ///< wall time of the round
};

/// The state of a solver.
struct SolveProgress {
  int iteration = 0;      ///< iterations finished
  int direction = 0;      ///< passes finished in the current iteration
  int passes = 0;         ///< passes of the current iteration: M, or fewer in Scheme::growing
  bool finished = false;  ///< converged, or all iterations done
  double change = 0;      ///< IterationRecord::change of the last finished iteration
  double seconds_transfers = 0;  ///< wall time of all passes so far
  double passes_per_second = 0;  ///< in the current iteration
  double seconds_left = 0;       ///< of the current iteration, estimated
  Vec3 last_direction;           ///< omega of the last finished pass
  /// What is under way. With lobes (GlossySolver), these are scaled before the first iteration, and
  /// reflect in each after its passes.
  enum class Stage { passes, scaling_lobes, reflecting };
  Stage stage = Stage::passes;  ///< the present one
  double stage_share = 0;       ///< finished share of a stage of lobes, 0 to 1
  double lobes_per_second = 0;  ///< in a stage of lobes; one is a shape and orientation
};

/// The error of B due to the finite number of directions, estimated from the spread of
/// independently rotated replicas; no reference is needed. A random rotation makes each replica
/// unbiased (eq. 47), so B ± quantile * standard error contains the B of infinitely many directions
/// in 95 % of all runs. Bounds of what is left of the start (semi-iterative scheme), or of what
/// further iterations would change (others, converged or not), and the estimated error of the first
/// shot (DirectLight::irradiance_error) are included as the root of the sum of squares.
struct ErrorEstimate {
  int replicas = 0;                 ///< 0: no estimate, all other members are empty
  std::vector<Rgb> standard_error;  ///< of B, W/m², one per patch
  double quantile = 0;  ///< Student's t, two-sided 95 %, replicas - 1 degrees of freedom
  /// RMS of the errors over RMS of the reflected light (reflected_light()), over patches and
  /// channels
  double rms = 0;
  /// What the relative RMS error does not exceed in 95 % of all runs. Larger than `rms` by the
  /// uncertainty of an estimate from few replicas: a quantile of the F distribution, less so the
  /// more independent the errors of the patches are.
  double rms_limit = 0;
  double rms_lowest = 0;  ///< what it exceeds in 95 % of all runs; with rms_limit a 90 % interval
  /// Number of independent errors that would vary as those of all patches do together, >= 1
  double independent_errors = 1;
  Rgb mean_radiosity;       ///< area-weighted mean of B, W/m²
  Rgb mean_standard_error;  ///< of this mean, W/m²
  Rgb mean_reflected;       ///< area-weighted mean of B - E, W/m²
};

/// Figures of a solve in which lobes take part.
struct GlossyFigures {
  std::int64_t patches = 0;  ///< that have a lobe; 0: none took part
  std::int64_t lobes = 0;    ///< different ones: by shape and orientation
  /// Largest difference from 1 of the sum over the directions of a lobe that reflects everything,
  /// before it was scaled: above a few percent, the directions are too few for it.
  double sum_error = 0;
  /// The same after scaling: rounding.
  double sum_defect = 0;
  /// Share of the light of lobes that scaling could not put around the mirror direction, largest.
  double spread = 0;
  double exponent = 0;               ///< largest exponent; of ggx, of the Phong lobe as wide
  std::uint64_t radiance_bytes = 0;  ///< memory of radiances by direction
  std::uint64_t lobe_bytes = 0;      ///< memory of the scales of lobes
  std::uint64_t transfer_bytes = 0;  ///< memory of kept transfers; 0: computed in each iteration
};

/// Figures of a solve run. Times are wall times.
struct SolveStatistics {
  std::int64_t patches = 0;        ///< of the scene
  std::int64_t fragments = 0;      ///< of the BSP tree
  int directions = 0;              ///< used: M or 2M
  int passes = 0;                  ///< M
  std::int64_t passes_made = 0;    ///< by the engine, in all iterations
  std::int64_t hemicubes = 0;      ///< drawn instead of passes; a direction is then one pixel
  std::int64_t pairs = 0;          ///< of patches, computed instead of passes
  int iterations = 0;              ///< finished
  int burn_in = 0;                 ///< semi_iterative: iterations omitted from the mean
  int threads = 0;                 ///< used
  std::int64_t transfers = 0;      ///< exchanges found, over all different directions
  std::int64_t form_factors = 0;   ///< kept entries; 0 where they are recomputed
  bool kept_form_factors = false;  ///< the exchange sums of all passes are in memory
  /// The tolerance was reached, or changes are rounding; never while the power of the last change
  /// is more than ten tolerances of the emitted power
  bool converged = false;
  double closure_defect_max = 0;      ///< largest ClosureDefect::relative (ALGORITHM.md, oracle 1)
  double closure_defect_grazing = 0;  ///< largest ClosureDefect::grazing
  double closure_defect_moments = 0;  ///< largest ClosureDefect::moments; 0: Basis::constant
  /// Corners of patches at which a channel of B is below 0, of Basis::linear; set by
  /// RadiositySolver::solution()
  std::int64_t negative_corners = 0;
  /// Directions that bring a patch the light of a source: (sum c)² / sum c² of the light c that it
  /// receives along each; mean over pairs of patch and source, each weighted by what it contributes
  /// to the variance of B. 0: no direct light. Below least_light_directions per replica, the error
  /// estimate cannot be trusted.
  double light_directions = 0;
  double escaped = 0;        ///< share of projected area with nothing above; 0: closed
  double energy_defect = 0;  ///< |sum A_i H_i - sum_j s_j A_j B_j| over the latter
                             ///< (ALGORITHM.md, oracle 4)
  /// Power absorbed, sum A_i (1 - rho_i) H_i, over that emitted, sum A_i E_i, and received from the
  /// sky; 1 in a closed scene.
  double energy_balance = 0;
  double rho_max = 0;                              ///< largest reflectance
  double predicted_contraction = 0;                ///< rho_max (1 + eps(M)/pi), eq. 22 with eq. 21
  PassCounts counts;                               ///< sum over all different directions
  std::vector<IterationRecord> iteration_records;  ///< one per iteration
  std::vector<RefinementRound> refinement;  ///< rounds that led to the scene; set by the caller
  std::int64_t shot_sources = 0;  ///< patches whose emission was shot before the iteration
  double shot_power_share = 0;    ///< their power over all power emitted
  /// Largest difference between the first shot and what the passes see of its sources, over what
  /// the errors of both explain; above 1, one of them is wrong. 0 without a shot, and with engines
  /// that are not exact.
  double shot_disagreement = 0;
  PatchId shot_disagreement_patch = -1;  ///< that receives it; -1: all patches together
  /// Pairs of patches with nothing between, of engine pairs and of the first shot, of which the
  /// form factor was integrated numerically because the closed form would lose digits.
  std::int64_t integrated_pairs = 0;
  GlossyFigures glossy;           ///< of a glossy solve
  double seconds_load = 0;        ///< reading the scene; set by the caller
  double seconds_bsp = 0;         ///< building the BSP tree
  double seconds_first_shot = 0;  ///< first shot
  double seconds_transfers = 0;   ///< passes
  double seconds_iterate = 0;     ///< iterating
  double seconds_total = 0;       ///< all of these
};

/// Number of directions per replica that must bring a patch its direct light for its error estimate
/// to be trusted (SolveStatistics::light_directions; decisions/0052-accuracy.md).
inline constexpr double least_light_directions = 3;

struct Solution;
class GlossyLight;

/// The parts that a solver starts from. The solver makes each part that is null.
struct SolverParts {
  std::shared_ptr<const BspTree> tree = nullptr;  ///< of the scene
  /// Direct light of the scene's small sources, if SolveOptions::first_shot is set.
  std::shared_ptr<const DirectLight> shot = nullptr;
  /// Makes the passes, such as an engine that reads them from a file; null: SolveOptions::engine.
  TransferEngine engine = {};
  /// Where the sums over passes are kept; null: all of them in the memory of this process. Of
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
  /// @param parts what the caller has already.
  /// @param cancellation checked here and in advance().
  /// @throws InputError, Canceled
  RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                  SolverParts parts = {}, const Cancellation& cancellation = {});
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
  /// @throws Canceled; NotConvergent, MemoryLimitExceeded (solve_errors.h).
  /// Of several processes, all pause after the same pass where an observer returns false in one;
  /// observers see the progress, but B only after complete_estimate().
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
  /// Figures of the run so far.
  SolveStatistics statistics() const;

  /// B of the last finished iteration, W/m², one per patch; before the first: E, plus the
  /// contribution of the first shot. Of Basis::linear its mean over the patch.
  const std::vector<Rgb>& radiosity() const;
  /// The linear parts of B, one per patch, of what solution() returns as radiosity; empty for
  /// Basis::constant.
  std::vector<LinearPart> linear_parts() const;
  /// B of the current iteration, W/m², estimated from the passes done so far; radiosity() between
  /// iterations.
  std::vector<Rgb> running_estimate() const;
  /// H of the last finished iteration, W/m², one per patch; of Basis::linear its mean over the
  /// patch.
  const std::vector<Rgb>& irradiance() const;
  /// Keeps form factors in the semi-iterative scheme too, from the next pass on. The other schemes
  /// always keep them if SolveOptions::memory suffices.
  void keep_form_factors();
  /// Continues a finished solve with one replica more, whose set has as many directions as that of
  /// the last: options().directions and options().replicas increase. radiosity() remains until the
  /// next iteration is finished.
  /// @throws std::logic_error unless the solve is finished, its scheme is fixed or
  /// conjugate_gradients, and it has at least 2 replicas.
  void add_replica();
  /// Writes the state: all that passes and iterations have led to. An observer may call it. Of
  /// several processes all must, after the same pass; the first writes the state of all, in the
  /// format of one.
  /// @param out binary; its errors are left to the caller.
  void save(std::ostream& out) const;
  /// Sets the state to one that save() wrote in the same version of the library, from a solver with
  /// the same scene and options; the number of threads may differ. The solve then continues to the
  /// same bits. To be called before advance().
  /// Of several processes all must call it, each with the whole state, and then
  /// complete_estimate().
  /// @param in binary.
  /// @param size length of the state, bytes.
  /// @throws std::runtime_error where it is damaged or of another scene; the solver may then only
  /// be destroyed.
  void restore(std::istream& in, std::uint64_t size);
  /// F_ij of all pairs, from the kept exchange sums of all passes; in the semi-iterative scheme, of
  /// all iterations. Of Basis::linear those of constant functions, which alone do not give its B.
  /// @throws std::runtime_error where no iteration is finished or one is unfinished, or where they
  /// were not kept or exceed the memory limit. Of several processes all must call it; it returns
  /// them in the first, and empty rows in the others.
  FormFactors form_factors() const;
  /// sum_j F_ij, one per patch, from the passes done so far; 1 within eps(M)/pi where i is
  /// enclosed.
  std::vector<double> form_factor_sums() const;
  /// Per patch: share of the light leaving it that escapes, meeting no patch; from the passes done
  /// so far, with the weights of form_factor_sums(). Where no backs are seen, both sum to 1 (eq.
  /// 17).
  std::vector<double> sky_shares() const;
  /// Per patch: what it receives from SolveOptions::sky, W/m², from the passes done so far; empty
  /// without a sky. In the semi-iterative scheme, of the last set of directions.
  std::vector<Rgb> sky_irradiance() const;
  /// Per patch: share of its visible area, over all passes so far, of which receivers see the back
  /// side.
  std::vector<double> back_seen_shares() const;
  /// The error estimate from replicas: of radiosity(), or within an iteration of
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
  /// bounds. In the semi-iterative scheme of the current set of directions only.
  const std::vector<double>& quadrature_errors() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The result of a solve run.
struct Solution {
  std::shared_ptr<const Scene> scene;  ///< the scene
  std::vector<Rgb> radiosity;          ///< B, W/m², one per patch
  std::vector<Rgb> irradiance;         ///< H, W/m², one per patch
  ErrorEstimate error;                 ///< from replicas, if there are any
  SolveStatistics statistics;          ///< figures of the run
  bool complete = false;  ///< false: stopped early, radiosity is the best estimate so far
  std::optional<AccuracyReport> accuracy = {};  ///< of a solve with a goal
  /// sum_j F_ij, one per patch; empty: not known
  std::vector<double> form_factor_sums = {};
  /// RadiositySolver::sky_shares(); of solves with given form factors, 1 - sum_j F_ij, which counts
  /// what meets back sides as escaping. Empty: not known.
  std::vector<double> sky_shares = {};
  /// RadiositySolver::sky_irradiance(); part of `irradiance`; empty: there is no sky
  std::vector<Rgb> sky_irradiance = {};
  Sky sky = {};  ///< SolveOptions::sky
  /// Of solves with given form factors; null: RadiositySolver::form_factors() may have them.
  std::shared_ptr<const FormFactors> form_factors = nullptr;
  /// RadiositySolver::linear_parts(), of Basis::linear, whose mean over a patch is `radiosity`;
  /// empty: B is constant on patches
  std::vector<LinearPart> linear_parts = {};
  /// Radiance by direction, of a glossy solve in which lobes took part; else null. `radiosity` is
  /// then E + (rho + reflectance of the lobe) H.
  std::shared_ptr<const GlossyLight> glossy = nullptr;
  /// A point from which patches are seen, whose radiance toward it result files then have.
  std::optional<Vec3> eye = std::nullopt;
};

/// The reflected light B - E of each patch, W/m², which relative changes, errors and differences
/// are relative to. It is 0 for patches that emit, unless all emit or the others reflect nothing.
/// @param b B, W/m², one value per patch; with a linear basis three, the mean first.
std::vector<Rgb> reflected_light(const Scene& scene, const std::vector<Rgb>& b);

/// B at the corners of patch i's outline, W/m². Of Basis::linear it may be below 0.
std::vector<Rgb> corner_radiosity(const Solution& solution, PatchId i);

/// The patches whose standard errors may be much too small: all replicas miss light alike that
/// comes to them from a small source. Not measured but expected, by sizes and distances: light of
/// sources that fewer than least_light_directions per replica bring to the patch is more than half
/// of its interval. What stands between is not counted, so these may be too many.
/// @param solution of passes with replicas; otherwise, and where all sources were shot first or
/// patches times sources exceed 2^22, the result is empty.
std::vector<PatchId> uncertain_patches(const Solution& solution);

}  // namespace TRANSILLUM_API transillum
