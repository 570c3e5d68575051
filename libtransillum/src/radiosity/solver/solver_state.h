// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// RadiositySolver::Impl: the parts of a solver and the order in which they are used. Each part has
// one job and its own header; solver_state.cpp has the iteration, solver_results.cpp what is
// read from it, radiosity_solver.cpp the public class.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>

#include "radiosity/exchange/pass_plan.h"
#include "radiosity/solver/iteration_history.h"
#include "radiosity/solver/iteration_under_way.h"
#include "radiosity/solver/kept_exchanges.h"
#include "radiosity/solver/pass_statistics.h"
#include "radiosity/solver/radiosity_iterate.h"
#include "radiosity/solver/replicas.h"
#include "radiosity/solver/solver_input.h"
#include "radiosity/solver/solver_timing.h"
#include "transillum/radiosity_solver.h"
#include "transillum/solution.h"

namespace transillum {

struct [[gnu::visibility("hidden")]] RadiositySolver::Impl {
  SolverInput input;
  PassPlan plan;                ///< which direction each pass takes
  RadiosityIterate whole;       ///< B from all passes
  Replicas replicas;            ///< B from each replica's passes
  KeptExchanges kept;           ///< exchanges of the passes so far
  PassStatistics statistics;    ///< measured along each direction once
  IterationUnderWay iteration;  ///< in progress
  IterationHistory history;     ///< finished iterations, and the answer so far
  SolverTiming timing;
  OwnedPatches owned;
  ReflectedLight light;  ///< light reflected in the scene

  explicit Impl(SolverInput solver_input);

  /// Number of passes of the iteration under way, and how many of them are done.
  int passes_needed() const { return plan.passes(history.size()); }
  int passes_done() const { return iteration.begun ? whole.passes() : 0; }
  /// Whether pass k of the iteration under way is the first along its direction, if the first
  /// `known` directions were used before. Any thread may call it.
  bool is_first_along(int k, int known) const { return plan.renews() || k >= known; }
  /// Areas of the passes whose exchanges are kept.
  const VisibleAreaSums& kept_areas() const {
    return plan.renews() ? kept.renewed_areas() : statistics.areas();
  }
  /// Calls visit(iterate, its sums) for B of all passes, then of each replica.
  template <class Visit>
  void for_each_iterate(Visit visit) {
    visit(whole, kept.all());
    replicas.for_each(
        [&](RadiosityIterate& iterate, std::size_t r) { visit(iterate, kept.of_replica(r)); });
  }

  /// Starts an iteration from the kept sums, if any; the rest is left to passes.
  void begin_iteration();
  /// Makes the passes up to `last` - 1. They are added in order, so the sums have the same bits for
  /// any number of threads. Returns false if the observer did.
  bool advance_passes(int last, const RadiositySolver& self, const Observer& observer);
  /// A pure function of k and `known`, as in is_first_along().
  Pass make_pass(int k, int known) const;
  /// Sorts the exchanges of pass k, if they are to be kept. Any thread may call it.
  void prepare_pass(int k, int known, Pass& pass) const;
  /// Adds pass k; in the order of the passes, on one thread at a time.
  void add_pass(int k, Pass pass);
  /// Updates the estimate of B for the share's patches.
  EstimateChange update_estimate();
  /// Completes what is largest over patches in the passes added, and drops the kept exchanges where
  /// any process had to.
  /// @throws MemoryLimitExceeded where that is not allowed
  void settle();
  /// Completes what is summed per patch, and the estimate of B. Every getter then returns the same
  /// in every process.
  void complete();
  /// B(n+1) from what was gathered, and the stopping rule (eq. 25).
  void finish_iteration();
  /// Continues with one replica more.
  void add_replica();
  /// The same as RadiositySolver::save() and restore()
  void save(std::ostream& out) const;
  void restore(std::istream& in, std::uint64_t size);
  /// Power received against power sent, before rows are scaled (ALGORITHM.md, oracle 4).
  double energy_defect() const;

  SolveProgress progress() const;
  SolveStatistics solve_statistics() const;
  /// The same as RadiositySolver::sky_irradiance()
  std::vector<Rgb> sky_irradiance() const;
  FormFactors form_factors() const;
  ErrorEstimate error_estimate() const;

 private:
  /// Makes room for the passes of a replica more.
  void append_replica();
  template <class Archive, class Self>
  static void visit_state(Archive& archive, Self& self);
};

}  // namespace transillum
