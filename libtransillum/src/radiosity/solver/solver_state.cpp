// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/solver/solver_state.h"

#include <fmt/format.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "radiosity/memory_limit.h"
#include "transillum/at.h"
#include "transillum/not_convergent.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

const SolveOptions& validated(const SolveOptions& options) {
  options.validate();
  return options;
}

double max_norm(const std::vector<Rgb>& b) {
  double largest = 0;
  for (const Rgb& value : b) {
    largest = std::max(largest, max_abs(value));
  }
  return largest;
}

double max_distance(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, max_abs(a[i] - b[i]));
  }
  return largest;
}

}  // namespace

RadiositySolver::Impl::Impl(std::shared_ptr<const Scene> solved, const SolveOptions& how,
                            std::shared_ptr<const BspTree> ready_tree, const Cancellation& stop,
                            std::shared_ptr<const DirectLight> ready_shot)
    : scene(std::move(solved)),
      options(validated(how)),
      tree(std::move(ready_tree)),
      cancellation(stop),
      plan(how),
      directions(plan.directions(0)),
      shot(std::move(ready_shot)),
      whole(*scene, how, *light_of_shot()),
      areas(static_cast<std::size_t>(scene->patch_count())),
      renewed_areas(areas) {
  threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  if (!tree) {
    const auto start = Clock::now();
    tree = std::make_shared<const BspTree>(*scene, cancellation);
    seconds_bsp = seconds_since(start);
  }
  engine = make_engine(options.engine, scene, tree, options.engine_options);
  if (options.replicas > 1) {
    for (int r = 0; r < options.replicas; ++r) {
      replicas.emplace_back(*scene, options, *shot);
    }
    replica_means.resize(replicas.size());
  }
  const std::uint64_t memory = memory_limit(options.memory);
  for (int r = 0; r < options.replicas; ++r) {
    sums.emplace_back(scene->patch_count(), options.two_way,
                      memory / static_cast<std::uint64_t>(options.replicas), cancellation);
  }
  const auto patches = static_cast<std::size_t>(scene->patch_count());
  b = estimate = whole.b();
  h = whole.h();
  facing_area.resize(patches);
  back_seen.resize(patches);
}

const std::shared_ptr<const DirectLight>& RadiositySolver::Impl::light_of_shot() {
  if (!shot) {
    const auto start = Clock::now();
    std::vector<PatchId> sources;
    if (options.first_shot) {
      sources = find_small_sources(*scene, *options.first_shot);
    }
    shot =
        std::make_shared<const DirectLight>(shoot(*scene, sources, options.threads, cancellation));
    seconds_first_shot = seconds_since(start);
  }
  return shot;
}

bool RadiositySolver::Impl::keeps_sums() const {
  return wants_sums() &&
         std::none_of(sums.begin(), sums.end(), [](const auto& s) { return s.overrun(); });
}

KeptSums RadiositySolver::Impl::all_sums() const {
  KeptSums all;
  for (const ExchangeSums& part : sums) {
    all.push_back(&part);
  }
  return all;
}

void RadiositySolver::Impl::begin_step() {
  const auto start = Clock::now();
  if (plan.renews() && !steps.empty()) {
    directions = plan.directions(step());
    areas = SeenAreas(b.size());
    quadrature_errors.clear();
  }
  const bool from_sums = keeps_sums() && areas.passes > 0;
  if (from_sums && options.scheme == Scheme::conjugate_gradients && steps.size() == 1) {
    for_each_iterate([&](RadiosityIterate& iterate, const KeptSums& kept) {
      iterate.leap(kept, 0.1 * options.tolerance, cancellation);
    });
  }
  for_each_iterate([&](RadiosityIterate& iterate, const KeptSums& kept) {
    cancellation.throw_if_canceled();
    if (from_sums) {
      iterate.begin(kept);
    } else {
      iterate.begin();
    }
  });
  begun = true;
  taken_over = whole.passes();
  if (taken_over > 0) {
    find_estimate();
  }
  const double seconds = seconds_since(start);
  seconds_iterate += seconds;
  step_seconds += seconds;
}

Pass RadiositySolver::Impl::make_pass(int k, int known) const {
  Pass pass;
  pass.transfers = engine(at(directions, k), cancellation);
  if (is_new(k, known)) {
    if (wants_sums()) {
      pass.run = sums.front().make_run(pass.transfers.exchanges);
    }
    pass.closure = closure_defect(pass.transfers, *scene);
  }
  return pass;
}

void RadiositySolver::Impl::absorb(int k, Pass pass) {
  const auto start = Clock::now();
  const bool news = is_new(k, areas.passes);
  if (news && keeps_sums()) {
    keep(k, std::move(pass.run));
  }
  whole.add(pass.transfers);
  if (!replicas.empty()) {
    replicas[replica_of(k)].add(pass.transfers);
  }
  if (news) {
    learn(pass);
  }
  ++passes_made;
  estimate_changes.push_back(find_estimate());
  seconds_iterate += seconds_since(start);
}

void RadiositySolver::Impl::learn(const Pass& pass) {
  const Transfers& transfers = pass.transfers;
  areas.add(transfers, options.two_way);
  if (plan.renews() && keeps_renewed) {
    renewed_areas.add(transfers, options.two_way);
  }
  double worst = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double exact = areas.passes * ways() * scene->patches()[i].area / 4;
    worst = std::max(worst, std::abs(areas.projected[i] / exact - 1));
    const Coverage& forward = transfers.forward[i];
    const Coverage& backward = transfers.backward[i];
    facing_area[i] += forward.projected + backward.projected;
    back_seen[i] += transfers.back_seen[i];
    seen += forward.projected + backward.projected;
    covered += forward.covered + backward.covered;
  }
  quadrature_errors.push_back(std::numbers::pi * worst);
  closure_relative = std::max(closure_relative, pass.closure.relative);
  closure_grazing = std::max(closure_grazing, pass.closure.grazing);
  counts += transfers.counts;
  transfer_count += static_cast<std::int64_t>(transfers.exchanges.size());
}

void RadiositySolver::Impl::keep(int k, ExchangeSums::Run run) {
  sums[replica_of(k)].add(std::move(run));
  // Where one part does not fit, the others are of no use.
  if (!keeps_sums()) {
    for (ExchangeSums& part : sums) {
      part.drop();
    }
    check_memory();
  }
}

void RadiositySolver::Impl::check_memory() const {
  const bool symmetric = options.normalize == Normalization::symmetric;
  const bool conjugate = options.scheme == Scheme::conjugate_gradients;
  if (keeps_sums() || !(symmetric || conjugate)) {
    return;
  }
  throw std::runtime_error(
      fmt::format("{} wants kept form factors, and they take more than --memory allows",
                  symmetric ? "a symmetric normalization" : "the scheme conjugate-gradients"));
}

double RadiositySolver::Impl::find_estimate() {
  double change = 0, largest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    Rgb value = whole.estimate(static_cast<PatchId>(i));
    if (mean_b.count > 0) {
      value = (1.0 / (mean_b.count + 1)) * (mean_b.sum[i] + value);
    }
    change = std::max(change, max_abs(value - estimate[i]));
    largest = std::max(largest, max_abs(value));
    estimate[i] = value;
  }
  return share(change, largest);
}

void RadiositySolver::Impl::finish_step() {
  const auto start = Clock::now();
  if (whole.passes() > taken_over && keeps_sums()) {
    for (ExchangeSums& part : sums) {
      part.finish();
    }
    if (!plan.renews()) {
      for_each_iterate([](RadiosityIterate& iterate, const KeptSums& kept) { iterate.keep(kept); });
    }
  }
  check_memory();
  measure_energy();
  const bool complete = whole.passes() == options.directions;
  double absolute = whole.finish();
  for (RadiosityIterate& replica : replicas) {
    replica.finish();
  }
  if (plan.renews()) {
    absolute = average();
  } else {
    b = whole.b();
    h = whole.h();
  }
  const double seconds = seconds_since(start);
  seconds_iterate += seconds;
  step_seconds += seconds;
  IterationRecord record;
  record.change = share(absolute, max_norm(b));
  record.contraction = steps.empty() ? 0.0 : share(absolute, last_absolute_change);
  record.seconds = step_seconds;
  last_absolute_change = absolute;
  steps.push_back(record);
  converged = complete && record.change <= options.tolerance && !in_burn_in();
  finished = options.iterations > 0 ? step() >= options.iterations : converged;
  begun = false;
  estimate_changes.clear();
  estimate = b;
  step_seconds = 0;
  check_contraction();
}

double RadiositySolver::Impl::average() {
  if (step() >= options.burn_in) {
    mean_b.add(whole.b());
    mean_h.add(whole.h());
    for (std::size_t r = 0; r < replicas.size(); ++r) {
      replica_means[r].add(replicas[r].b());
    }
  }
  std::vector<Rgb> next = in_burn_in() ? whole.b() : mean_b.mean();
  h = in_burn_in() ? whole.h() : mean_h.mean();
  const double change = max_distance(next, b);
  b = std::move(next);
  return change;
}

void RadiositySolver::Impl::measure_energy() {
  Rgb received;
  for (const Rgb& value : whole.gathered()) {
    received += value;
  }
  const Rgb sent = whole.sent(options.two_way ? areas.rows : areas.columns);
  energy_defect = share(max_abs(received - sent), max_abs(sent));
}

void RadiositySolver::Impl::check_contraction() const {
  constexpr std::size_t patience = 20;
  if (finished || steps.size() < patience) {
    return;
  }
  const bool growing = std::all_of(steps.end() - patience / 2, steps.end(),
                                   [](const IterationRecord& s) { return s.contraction >= 1; });
  if (growing) {
    throw NotConvergent(fmt::format(
        "the iteration does not converge: each change is {:.3g} times the one before; take more "
        "directions than {}, or --normalize rows",
        steps.back().contraction, options.directions));
  }
}

bool RadiositySolver::Impl::advance_direction(const RadiositySolver& self,
                                              const Observer& observer) {
  const auto start = Clock::now();
  const int k = done();
  Pass pass = make_pass(k, areas.passes);
  seconds_transfers += seconds_since(start);
  absorb(k, std::move(pass));
  step_seconds += seconds_since(start);
  return !observer || observer(self);
}

bool RadiositySolver::Impl::advance_passes(const RadiositySolver& self, const Observer& observer) {
  bool going = true;
  auto last = Clock::now();
  double wall = 0, absorbing = -seconds_iterate;
  const int known = plan.renews() ? 0 : areas.passes;
  const auto conclude = [&] {
    absorbing += seconds_iterate;
    seconds_transfers += std::max(0.0, wall - absorbing / threads);
  };
  try {
    PassRunner(threads).run(
        done(), wanted(), [this, known](int k) { return make_pass(k, known); },
        [&](int k, Pass pass) {
          absorb(k, std::move(pass));
          const double now = seconds_since(last);
          last = Clock::now();
          wall += now;
          step_seconds += now;
          if (observer && !observer(self)) {
            going = false;
          }
          return going;
        });
  } catch (...) {
    conclude();
    throw;
  }
  conclude();
  return going;
}

}  // namespace transillum
