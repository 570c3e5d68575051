// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/solver/exchange_sums.h"
#include "radiosity/solver/pass_plan.h"
#include "radiosity/solver/pass_runner.h"
#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/running_mean.h"
#include "radiosity/solver/visible_areas.h"
#include "transillum/radiosity.h"

namespace transillum {

/// All that a solver knows, and what it does step by step. RadiositySolver is its face.
struct RadiositySolver::Impl {
  // What is solved, and how.
  std::shared_ptr<const Scene> scene;
  SolveOptions options;
  std::shared_ptr<const BspTree> tree;
  Cancellation cancellation;
  TransferEngine engine;
  PassPlan plan;
  int threads = 1;

  // The step under way.
  bool begun = false;
  std::vector<Vec3> directions;  ///< in the order of the passes
  int taken_over = 0;            ///< passes that it has from kept sums
  std::vector<Rgb> estimate;     ///< of B
  std::vector<double> estimate_changes;
  double step_seconds = 0;

  std::shared_ptr<const DirectLight> shot;  ///< of the first shot; zeros where there is none
  double seconds_first_shot = 0;

  // B of all passes, and of each replica's.
  RadiosityIterate whole;
  std::vector<RadiosityIterate> replicas;

  // The steps before.
  RunningMean mean_b, mean_h;  ///< where the scheme is semi-iterative
  std::vector<RunningMean> replica_means;
  std::vector<Rgb> b, h;  ///< the answer so far
  std::vector<IterationRecord> steps;
  double last_absolute_change = 0;
  bool finished = false, converged = false;

  // Learned from each direction once.
  SeenAreas areas;
  std::vector<ExchangeSums> sums;  ///< a replica each, or one
  bool keeps_renewed = false;      ///< also where each step has directions of its own
  SeenAreas renewed_areas;         ///< of the passes of all steps in `sums` then
  std::vector<double> facing_area, back_seen;
  std::vector<double> quadrature_errors;  ///< after each of the passes in `areas`
  double closure_relative = 0, closure_grazing = 0, covered = 0, seen = 0;
  std::int64_t transfer_count = 0;
  PassCounts counts;

  double energy_defect = 0;
  std::int64_t passes_made = 0;
  double seconds_bsp = 0, seconds_transfers = 0, seconds_iterate = 0;

  Impl(std::shared_ptr<const Scene> solved, const SolveOptions& how,
       std::shared_ptr<const BspTree> ready_tree, const Cancellation& stop,
       std::shared_ptr<const DirectLight> ready_shot);

  /// The first shot's light; shoots where that is still to be done.
  const std::shared_ptr<const DirectLight>& light_of_shot();

  int ways() const { return options.two_way ? 2 : 1; }
  int step() const { return static_cast<int>(steps.size()); }
  /// Passes that the step under way takes, and that it has.
  int wanted() const { return plan.passes(step()); }
  int done() const { return begun ? whole.passes() : 0; }
  /// Whether passes are to be kept, were there the memory.
  bool wants_sums() const { return !plan.renews() || keeps_renewed; }
  bool keeps_sums() const;
  /// What the passes in `sums` have seen.
  const SeenAreas& kept_areas() const { return plan.renews() ? renewed_areas : areas; }
  KeptSums all_sums() const;
  std::size_t replica_of(int k) const { return static_cast<std::size_t>(k) % sums.size(); }

  /// Calls visit(iterate, its sums) for B of all passes and of each replica's.
  template <class Visit>
  void for_each_iterate(Visit visit) {
    visit(whole, all_sums());
    for (std::size_t r = 0; r < replicas.size(); ++r) {
      visit(replicas[r], KeptSums{&sums[r]});
    }
  }

  /// Takes over what kept sums have of this step; the rest is left to passes.
  void begin_step();
  /// Whether pass k of the step under way is the first along its direction, given that the first
  /// `known` have been learned from. Any thread may ask.
  bool is_new(int k, int known) const { return plan.renews() || k >= known; }
  /// A pure function of k and `known`, the passes that were learned from before.
  Pass make_pass(int k, int known) const;
  /// Adds pass k to the step under way; in order of the passes, on one thread at a time.
  void absorb(int k, Pass pass);
  /// What needs to be learned from each direction only once.
  void learn(const Pass& pass);
  void keep(int k, ExchangeSums::Run run);
  /// @throws std::runtime_error where kept sums are wanted and there are none.
  void check_memory() const;
  /// Returns how much the estimate changes, relative to its largest value.
  double find_estimate();
  /// B(n+1) from what was gathered, and the rule of eq. 25.
  void finish_step();
  /// Whether the steps so far count for nothing in the mean.
  bool in_burn_in() const { return plan.renews() && mean_b.count == 0; }
  /// The answer of the semi-iterative scheme; returns how much the step has changed it.
  double average();
  /// Power received against power sent, before any scaling of rows (oracle 4).
  void measure_energy();
  /// Too few directions for so much reflectance make rows sum to more than 1/rho.
  void check_contraction() const;

  /// One pass on this thread.
  bool advance_direction(const RadiositySolver& self, const Observer& observer);
  /// All passes that the step still lacks, over all threads; absorbed in order, so the sums are
  /// the same bits whatever the number of threads.
  bool advance_passes(const RadiositySolver& self, const Observer& observer);
};

/// Relative to `scale`, where there is any.
inline double share(double part, double scale) { return scale > 0 ? part / scale : 0.0; }

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace transillum
