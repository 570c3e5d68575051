// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "transillum/bsp_tree.h"
#include "transillum/cancellation.h"
#include "transillum/directions.h"
#include "transillum/engine.h"
#include "transillum/first_shot.h"
#include "transillum/form_factors.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum {

/// What is done to the form-factor matrix so that its rows sum to what they should.
enum class Normalization {
  none,       ///< the paper's plain estimator
  rows,       ///< rows divided by their quadrature of the cosine: removes the error of section 5.1,
              ///< the iteration contracts for every M, reciprocity is lost
  symmetric,  ///< rows and columns scaled alike to the same end: A_i F_ij = A_j F_ji stays.
              ///< Wants two_way and kept form factors
};
/// The names of the command line, in the order of the enumeration.
const std::vector<std::string>& normalization_names();
/// @throws InputError naming the choices.
Normalization normalization_from_name(const std::string& name);
const std::string& name_of(Normalization normalization);

/// Which directions a step takes, and what it makes of them (section 6).
enum class Scheme {
  fixed,                ///< the same M directions in every step (eq. 11)
  growing,              ///< twice as many each step up to M; none is computed twice (eq. 44)
  semi_iterative,       ///< M others each step, and the mean over steps (eq. 45)
  conjugate_gradients,  ///< as fixed, but solved on the symmetric form. Wants two_way, not rows
};
const std::vector<std::string>& scheme_names();
Scheme scheme_from_name(const std::string& name);
const std::string& name_of(Scheme scheme);

/// Options of a solve; the defaults are the command line's.
struct SolveOptions {
  int directions = 1024;  ///< M: passes an iteration step, 1 … 2^24
  Sampling sampling = Sampling::fibonacci;
  std::uint64_t seed = 1;  ///< of the samplings that are seeded, and of engine rays
  std::optional<std::uint64_t> rotation = {};  ///< seed of a rotation of all directions, if any
  Engine engine = Engine::fast;
  EngineOptions engine_options = {};
  bool two_way = true;  ///< each pass serves omega and -omega
  Normalization normalize = Normalization::none;
  Scheme scheme = Scheme::fixed;
  /// Small bright sources are shot first, from this R²/A on (find_small_sources); none: no shot.
  std::optional<double> first_shot = {};
  int burn_in = 8;     ///< semi_iterative: so many steps are left out of the mean
  int replicas = 1;    ///< 2 … 64: the M directions are so many independently rotated sets, whose
                       ///< spread gives an error estimate. At most M
  int iterations = 0;  ///< stop after so many steps; 0: by tolerance
  double tolerance = 1e-6;   ///< relative change of B in the maximum norm (eq. 25)
  std::uint64_t memory = 0;  ///< bytes kept form factors may take; 0: a quarter of the machine's
  int threads = 0;           ///< 0: all cores; the result does not depend on it

  /// @throws InputError naming the option and its range.
  void validate() const;
  friend bool operator==(const SolveOptions&, const SolveOptions&) = default;
};

/// One finished iteration step of eq. 11.
struct IterationRecord {
  double change = 0;  ///< ||B(n+1) - B(n)|| / ||B(n+1)||, maximum norm
  double contraction =
      0;  ///< ratio of this step's absolute change to the last one's; 0 in the first
  double seconds = 0;
};

/// Where a solver stands; cheap to copy but for the lists.
struct SolveProgress {
  int iteration = 0;             ///< finished steps
  int direction = 0;             ///< passes done in the step under way
  int passes = 0;                ///< passes this step takes: M, or less where it grows
  bool finished = false;         ///< converged, or all steps done
  double seconds_transfers = 0;  ///< wall time of passes so far
  double passes_per_second = 0;  ///< of the step under way
  double seconds_left = 0;       ///< of the step under way, estimated
  Vec3 last_direction;           ///< of the newest pass done
};

/// How far B may be off by its directions, from the spread of independently rotated replicas of
/// them: no reference is needed. Rotations make each replica right on average (eq. 47), so
/// B +- quantile * standard error holds the B of infinitely many directions 95 times in 100. The
/// first shot's own error is not in it.
struct ErrorEstimate {
  int replicas = 0;                 ///< 0: there is no estimate, and nothing below
  std::vector<Rgb> standard_error;  ///< of B, W/m², one a patch
  double quantile = 0;              ///< Student's, two-sided 95 %, replicas - 1 degrees of freedom
  double rms = 0;                   ///< RMS of the errors over RMS of B, over patches and channels
  Rgb mean_radiosity;               ///< of B by area, W/m²
  Rgb mean_standard_error;          ///< of this mean
};

/// What is known when a solve ends.
struct SolveStatistics {
  std::int64_t patches = 0, fragments = 0;
  int directions = 0;            ///< used: M or 2M
  int passes = 0;                ///< M
  std::int64_t passes_made = 0;  ///< by the engine, in all steps
  std::int64_t hemicubes = 0;    ///< drawn in place of passes; a direction is then a pixel of one
  int iterations = 0, threads = 0;
  std::int64_t transfers = 0;     ///< exchanges found, of every direction once
  std::int64_t form_factors = 0;  ///< kept entries; 0 where they are recomputed
  bool kept_form_factors = false;
  bool converged = false;
  double closure_defect_max = 0;      ///< over passes and patches seen at >= 1e-6 (oracle 1)
  double closure_defect_grazing = 0;  ///< patches seen at less, over the patch's area
  double escaped = 0;         ///< share of all projected area with nothing above it; 0: closed
  double energy_defect = 0;   ///< |sum A_i H_i - sum_j s_j A_j B_j| over the latter (oracle 4)
  double energy_balance = 0;  ///< sum A_i (1 - rho_i) H_i / sum A_i E_i; 1 in a closed scene
  double rho_max = 0;
  double predicted_contraction = 0;                ///< rho_max (1 + eps(M)/pi), eq. 22 with eq. 21
  PassCounts counts;                               ///< of every direction once, added up
  std::vector<IterationRecord> iteration_records;  ///< one per iteration
  std::int64_t shot_sources = 0;                   ///< patches whose emission was shot first
  double shot_power_share = 0;                     ///< of them in all power emitted
  double seconds_load = 0, seconds_bsp = 0, seconds_first_shot = 0, seconds_transfers = 0,
         seconds_iterate = 0, seconds_total = 0;
};

struct Solution;

/// Solves B_i = E_i + rho_i sum_j F_ij B_j (eq. 11, or 44 or 45 by its scheme), watched.
///
/// Threads: one thread at a time may call it. Inside advance() it spreads passes over
/// options.threads threads and sums them in a fixed order: the same bits for any number.
class RadiositySolver {
 public:
  /// @param tree of the scene; built here when null.
  /// @param shot light of the scene's small sources, where options.first_shot is set; shot here
  /// when null.
  /// @throws InputError, Canceled
  RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                  std::shared_ptr<const BspTree> tree = nullptr,
                  const Cancellation& cancellation = {},
                  std::shared_ptr<const DirectLight> shot = nullptr);
  ~RadiositySolver();
  RadiositySolver(RadiositySolver&&) noexcept;
  RadiositySolver& operator=(RadiositySolver&&) noexcept;

  /// How far one call of advance() goes. Where a step comes from kept form factors there are no
  /// directions left to stop at, and `direction` goes as far as `iteration`.
  enum class Until { direction, iteration, finished };
  /// Hears of every pass, in order, and of every finished step, on some thread but never on two
  /// at once; may read the solver; returns false to pause.
  using Observer = std::function<bool(const RadiositySolver&)>;

  /// Goes on. Returns whether there is more to do. After a pause or an exception the solver
  /// stands where the last observed pass left it, and advance() goes on from there.
  /// @throws Canceled; NotConvergent, MemoryLimitExceeded (solve_errors.h).
  bool advance(Until until, const Observer& observer = {});

  const Scene& scene() const;
  std::shared_ptr<const Scene> shared_scene() const;
  const BspTree& tree() const;
  std::shared_ptr<const BspTree> shared_tree() const;
  const SolveOptions& options() const;
  /// Of the first shot; zeros where there is none.
  std::shared_ptr<const DirectLight> direct_light() const;
  SolveProgress progress() const;
  /// omega of each pass of a step, in the order of the passes.
  const std::vector<Vec3>& directions() const;
  SolveStatistics statistics() const;

  /// B of the last finished step, W/m², one a patch; before the first E, and what the first
  /// shot adds.
  const std::vector<Rgb>& radiosity() const;
  /// The step under way, estimated from the passes done so far; radiosity() between steps.
  std::vector<Rgb> running_estimate() const;
  /// H of the last finished step, W/m², one a patch.
  const std::vector<Rgb>& irradiance() const;
  /// The semi-iterative scheme needs no form factors and keeps none, unless it is told to: from the
  /// next pass on. The other schemes always do.
  void keep_form_factors();
  /// F_ij of all pairs, from the kept sums of all passes; in the semi-iterative scheme those of all
  /// its steps.
  /// @throws std::runtime_error where no step is finished or one is under way, where they were not
  /// to be kept, or the memory did not take them.
  FormFactors form_factors() const;
  /// sum_j F_ij, one a patch, from the passes done so far; 1 within eps(M)/pi where i is enclosed.
  std::vector<double> form_factor_sums() const;
  /// A patch: share of its seen area, over all passes so far, at which receivers see its back.
  std::vector<double> back_seen_shares() const;
  /// From replicas, as they are at radiosity(), or at running_estimate() within a step.
  ErrorEstimate error_estimate() const;
  /// The direction of pass `pass` of iteration `iteration` (both from 0), as this solver takes
  /// them; `pass` below the passes of that step.
  Vec3 direction(int iteration, int pass) const;
  /// Within the step under way: relative change (maximum norm) of the running estimate at each
  /// pass against the one before; entry d belongs to pass d. Empty between steps.
  const std::vector<double>& estimate_changes() const;
  /// eps after each pass so far: the largest magnitude of eq. 17 over the patches, which eq. 21
  /// bounds. Of the semi-iterative scheme's newest set only.
  const std::vector<double>& quadrature_errors() const;
  /// The result so far: within an iteration the running estimate, else radiosity(); complete once
  /// the solve has finished. In its statistics, seconds_load is 0 and seconds_total is the sum of
  /// the solver's own times, which a caller that measures them may replace.
  Solution solution() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The answer of a solve.
struct Solution {
  std::shared_ptr<const Scene> scene;
  std::vector<Rgb> radiosity;   ///< B, W/m², one a patch
  std::vector<Rgb> irradiance;  ///< H, W/m²
  ErrorEstimate error;
  SolveStatistics statistics;
  bool complete = false;  ///< false: stopped early, radiosity is the best estimate so far
};

/// One call from a scene to its radiosity. When `cancellation` is set during the passes it
/// returns what there is, with complete = false.
/// @throws InputError, Canceled (before the first pass), std::runtime_error
Solution solve(std::shared_ptr<const Scene> scene, const SolveOptions& options,
               const RadiositySolver::Observer& observer = {},
               const Cancellation& cancellation = {});

}  // namespace transillum
