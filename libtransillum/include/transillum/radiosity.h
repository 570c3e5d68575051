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
#include "transillum/form_factors.h"
#include "transillum/scene.h"
#include "transillum/transfers.h"

namespace transillum {

/// Whether rows of the form-factor matrix are divided by their quadrature of the cosine.
enum class Normalization {
  none,  ///< the paper's plain estimator
  rows,  ///< removes the error of section 5.1; the iteration contracts for every M
};

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
  int iterations = 0;        ///< stop after so many steps; 0: by tolerance
  double tolerance = 1e-6;   ///< relative change of B in the maximum norm (eq. 25)
  std::uint64_t memory = 0;  ///< bytes kept form factors may take; 0: a quarter of the machine's
  int threads = 0;           ///< 0: all cores; the result does not depend on it

  /// @throws InputError naming the option and its range.
  void validate() const;
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
  int passes = 0;                ///< passes a step takes: M
  bool finished = false;         ///< converged, or all steps done
  double seconds_transfers = 0;  ///< wall time of passes so far
  double passes_per_second = 0;  ///< of the step under way
  double seconds_left = 0;       ///< of the step under way, estimated
  Vec3 last_direction;           ///< of the newest pass done
};

/// What is known when a solve ends.
struct SolveStatistics {
  std::int64_t patches = 0, fragments = 0;
  int directions = 0;  ///< used: M or 2M
  int passes = 0;      ///< M
  int iterations = 0, threads = 0;
  std::int64_t transfers = 0;     ///< exchanges found in one step's passes
  std::int64_t form_factors = 0;  ///< kept entries; 0 where they are recomputed
  bool kept_form_factors = false;
  bool converged = false;
  double closure_defect_max = 0;      ///< over passes and patches seen at >= 1e-6 (oracle 1)
  double closure_defect_grazing = 0;  ///< patches seen at less, over the patch's area
  double escaped = 0;         ///< share of all projected area with nothing above it; 0: closed
  double energy_defect = 0;   ///< |sum A_i H_i - sum_j s_j A_j B_j| over the latter (oracle 4)
  double energy_balance = 0;  ///< sum A_i (1 - rho_i) H_i / sum A_i E_i; 1 in a closed scene
  double rho_max = 0;
  double predicted_contraction = 0;  ///< rho_max (1 + eps(M)/pi), eq. 22 with eq. 21
  PassCounts counts;                 ///< of the first step's passes, added up
  std::vector<IterationRecord> steps;
  double seconds_load = 0, seconds_bsp = 0, seconds_transfers = 0, seconds_iterate = 0,
         seconds_total = 0;
};

/// Solves B_i = E_i + rho_i sum_j F_ij B_j (eq. 11) on a fixed set of directions, watched.
///
/// Threads: one thread at a time may call it. Inside advance() it spreads passes over
/// options.threads threads and sums them in a fixed order: the same bits for any number.
class RadiositySolver {
 public:
  /// @param tree of the scene; built here when null.
  /// @throws InputError, Cancelled
  RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                  std::shared_ptr<const BspTree> tree = nullptr,
                  const Cancellation& cancellation = {});
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
  /// @throws Cancelled, std::runtime_error where the iteration diverges.
  bool advance(Until until, const Observer& observer = {});

  const Scene& scene() const;
  std::shared_ptr<const Scene> shared_scene() const;
  const BspTree& tree() const;
  std::shared_ptr<const BspTree> shared_tree() const;
  const SolveOptions& options() const;
  SolveProgress progress() const;
  /// omega of each pass of a step, in the order of the passes.
  const std::vector<Vec3>& directions() const;
  SolveStatistics statistics() const;

  /// B of the last finished step, W/m², one a patch; E before the first.
  const std::vector<Rgb>& radiosity() const;
  /// The step under way, estimated from the passes done so far; radiosity() between steps.
  std::vector<Rgb> running_estimate() const;
  /// H of the last finished step, W/m², one a patch.
  const std::vector<Rgb>& irradiance() const;
  /// F_ij of all pairs, from the kept sums of the first step.
  /// @throws std::runtime_error where that is not finished, or the memory did not take them.
  FormFactors form_factors() const;
  /// sum_j F_ij, one a patch, from the passes done so far; 1 within eps(M)/pi where i is enclosed.
  std::vector<double> form_factor_sums() const;
  /// A patch: share of its seen area, over all passes so far, at which receivers see its back.
  std::vector<double> back_seen_shares() const;
  /// Within the step under way: relative change (maximum norm) of the running estimate at each
  /// pass against the one before; entry d belongs to pass d. Empty between steps.
  const std::vector<double>& estimate_changes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The answer of a solve.
struct Solution {
  std::shared_ptr<const Scene> scene;
  std::vector<Rgb> radiosity;   ///< B, W/m², one a patch
  std::vector<Rgb> irradiance;  ///< H, W/m²
  SolveStatistics statistics;
  bool complete = false;  ///< false: stopped early, radiosity is the best estimate so far
};

/// One call from a scene to its radiosity. When `cancellation` is set during the passes it
/// returns what there is, with complete = false.
/// @throws InputError, Cancelled (before the first pass), std::runtime_error
Solution solve(std::shared_ptr<const Scene> scene, const SolveOptions& options,
               const RadiositySolver::Observer& observer = {},
               const Cancellation& cancellation = {});

}  // namespace transillum
