// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// One iteration of the solver: begin, passes, finish.
#include "radiosity/solver/solver_state.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/seconds_since.h"
#include "radiosity/ratio.h"
#include "transillum/at.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

RadiositySolver::Impl::Impl(SolverInput solver_input)
    : input(std::move(solver_input)),
      plan(input.options),
      whole(*input.unknowns, input.options, input.owned()),
      replicas(input),
      kept(input, plan.renews()),
      statistics(*input.scene, input.options.two_way, *input.shot, input.owned(),
                 input.unknowns->per_patch, input.unknowns->means(input.unknowns->reflectance)),
      history(input, whole),
      owned(input.owned()),
      light(input.unknowns->light()) {
  iteration.directions = plan.directions(0);
  iteration.estimate = whole.b();
}

void RadiositySolver::Impl::begin_iteration() {
  const auto start = Clock::now();
  if (plan.renews() && history.size() > 0) {
    iteration.directions = plan.directions(history.size());
    statistics.begin_set();
  }
  const bool from_sums = kept.available() && statistics.areas().passes > 0;
  if (from_sums && traits_of(input.options.scheme).is_symmetric &&
      history.size_since_reopening() == 1) {
    // The error is up to 1 / (1 - rho_max) times the residual. One above 1e-6 could make B
    // negative.
    const double residual =
        std::min(0.1 * input.options.tolerance, 1e-6) * (1 - history.start().rho_max());
    for_each_iterate([&](RadiosityIterate& iterate, const KeptSums& sums) {
      iterate.set_to_limit(sums, residual, input.requested);
    });
  }
  for_each_iterate([&](RadiosityIterate& iterate, const KeptSums& sums) {
    input.throw_if_canceled();
    if (from_sums) {
      iterate.begin(sums);
    } else {
      iterate.begin();
    }
  });
  history.start().begin();
  iteration.begun = true;
  iteration.from_kept_sums = whole.passes();
  if (iteration.from_kept_sums > 0) {
    update_estimate();
    owned.complete(iteration.estimate);
  }
  const double seconds = seconds_since(start);
  timing.seconds_iterate += seconds;
  iteration.seconds += seconds;
}

bool RadiositySolver::Impl::advance_passes(int last, const RadiositySolver& self,
                                           const Observer& observer) {
  const auto start = Clock::now();
  const double seconds_before = iteration.seconds, adding_before = timing.seconds_iterate;
  const double passes_before = timing.seconds_transfers;
  // Wall time that all threads together did not spend on adding belongs to the passes.
  const int threads = std::min(input.threads, last - passes_done());
  const auto add_times = [&] {
    const double wall = seconds_since(start);
    const double adding = timing.seconds_iterate - adding_before;
    timing.seconds_transfers = passes_before + std::max(0.0, wall - adding / threads);
    iteration.seconds = seconds_before + wall;
  };
  const int known = plan.renews() ? 0 : statistics.areas().passes;
  PassLoop loop;
  loop.first = passes_done();
  loop.last = last;
  loop.threads = input.threads;
  loop.patches = owned.patches;
  loop.cancellation = input.requested;
  loop.make = [&](int k) { return make_pass(k, known); };
  loop.prepare = [&](int k, Pass& pass) { prepare_pass(k, known, pass); };
  loop.add = [&](int k, Pass pass) {
    add_pass(k, std::move(pass));
    add_times();  // before an observer reads the number of passes
  };
  loop.settle = [&] { settle(); };
  loop.observe = [&](int) { return !observer || observer(self); };
  try {
    const bool going = owned.sums->run(loop);
    add_times();
    complete();
    return going;
  } catch (const Canceled&) {
    add_times();
    complete();
    throw;
  } catch (...) {
    add_times();
    throw;
  }
}

void RadiositySolver::Impl::settle() {
  std::vector<double> largest{kept.requested() && !kept.available() ? 1.0 : 0.0};
  for (const EstimateChange& change : iteration.changes_of_owned) {
    largest.insert(largest.end(), {change.change, change.largest, change.largest_of_all});
  }
  owned.sums->maxima(largest);
  for (std::size_t k = 1; k < largest.size(); k += 3) {
    iteration.changes.push_back(
        EstimateChange{largest[k], largest[k + 1], largest[k + 2]}.relative());
  }
  iteration.changes_of_owned.clear();
  statistics.complete_errors();
  if (largest[0] > 0) {
    kept.drop();
    kept.check_available();
  }
}

void RadiositySolver::Impl::complete() {
  const auto start = Clock::now();
  for_each_iterate([](RadiosityIterate& iterate, const KeptSums&) { iterate.complete(); });
  history.start().complete();
  statistics.complete();
  kept.complete();
  owned.complete(iteration.estimate);
  timing.seconds_iterate += seconds_since(start);
}

Pass RadiositySolver::Impl::make_pass(int k, int known) const {
  Pass pass;
  pass.transfers = input.engine(at(iteration.directions, k), input.requested);
  if (is_first_along(k, known)) {
    pass.closure = closure_defect(pass.transfers, *input.scene);
    pass.exchanges = std::ssize(pass.transfers.exchanges);
    for (std::size_t i = 0; i < pass.transfers.forward.size(); ++i) {
      const Coverage &forward = pass.transfers.forward[i], &backward = pass.transfers.backward[i];
      pass.projected += forward.projected + backward.projected;
      pass.covered += forward.covered + backward.covered;
    }
  }
  return pass;
}

void RadiositySolver::Impl::prepare_pass(int k, int known, Pass& pass) const {
  if (is_first_along(k, known) && kept.requested()) {
    pass.sorted = kept.sort(pass.transfers);
  }
}

void RadiositySolver::Impl::add_pass(int k, Pass pass) {
  const auto start = Clock::now();
  const bool first = is_first_along(k, statistics.areas().passes);
  const std::size_t replica = plan.replica_of(k);
  if (first && kept.available()) {
    kept.add(replica, std::move(pass.sorted));
  }
  whole.add(pass.transfers);
  replicas.add(replica, pass.transfers);
  history.start().add(pass.transfers);
  if (first) {
    statistics.add(pass);
    kept.add_areas(pass.transfers);
  }
  ++timing.passes_made;
  iteration.changes_of_owned.push_back(update_estimate());
  timing.seconds_iterate += seconds_since(start);
}

EstimateChange RadiositySolver::Impl::update_estimate() {
  EstimateChange result;
  const OwnedPatches unknowns = owned.of_unknowns(input.unknowns->per_patch);
  for (std::size_t u = unknowns.first(); u < unknowns.last(); ++u) {
    const Rgb value = history.with(u, whole.estimate(u));
    result.change = std::max(result.change, max_abs(value - iteration.estimate[u]));
    const double reflected = max_abs(light.of(u, value));
    result.largest_of_all = std::max(result.largest_of_all, reflected);
    if (!light.emits(u)) {
      result.largest = std::max(result.largest, reflected);
    }
    iteration.estimate[u] = value;
  }
  return result;
}

void RadiositySolver::Impl::finish_iteration() {
  const auto start = Clock::now();
  if (whole.passes() > iteration.from_kept_sums && kept.available()) {
    kept.finish();
    if (!plan.renews()) {
      for_each_iterate([](RadiosityIterate& iterate, const KeptSums& sums) { iterate.keep(sums); });
    }
  }
  kept.check_available();
  iteration.energy_defect = energy_defect();
  const bool complete = whole.passes() == input.options.directions;
  const std::vector<Rgb> changes = whole.finish();
  replicas.finish();
  if (history.past_burn_in()) {
    replicas.add_to_means();
  }
  const double seconds = seconds_since(start);
  timing.seconds_iterate += seconds;
  history.update(whole, changes, iteration.seconds + seconds, complete);
  iteration.end(history.b());
  owned.check_same(history.b());
  if (history.finished()) {
    input.release_engine();
  }
}

void RadiositySolver::Impl::add_replica() {
  const Scheme scheme = input.options.scheme;
  if (!history.finished() || input.options.replicas < 2 ||
      (scheme != Scheme::fixed && !traits_of(scheme).is_symmetric)) {
    throw std::logic_error("add_replica: the solve is unfinished or has no replicas of one set");
  }
  input.require_engine();
  append_replica();
  iteration.directions = plan.directions(0);
  history.reopen(input.options.directions);
}

void RadiositySolver::Impl::append_replica() {
  plan.add_replica();
  input.options.directions = plan.directions();
  input.options.replicas = plan.replicas();
  replicas.add_replica(input, whole);
  kept.add_replica();
}

double RadiositySolver::Impl::energy_defect() const {
  Rgb received;
  // The power follows from the means.
  for (std::size_t u = 0; u < whole.gathered().size(); u += input.unknowns->per_patch) {
    received += whole.gathered()[u];
  }
  const VisibleAreaSums& areas = statistics.areas();
  const Rgb sent = whole.sent(input.options.two_way ? areas.rows : areas.columns);
  return ratio_or_zero(max_abs(received - sent), max_abs(sent));
}

}  // namespace transillum
