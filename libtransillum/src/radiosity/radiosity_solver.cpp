// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>
#include <oneapi/tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "radiosity/error_estimate.h"
#include "radiosity/exchange_sums.h"
#include "radiosity/iterate.h"
#include "radiosity/pass_plan.h"
#include "radiosity/pass_runner.h"
#include "transillum/bounds.h"
#include "transillum/not_convergent.h"
#include "transillum/radiosity.h"

namespace transillum {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::uint64_t quarter_of_memory() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE)) / 4;
}

double max_norm(const std::vector<Rgb>& b) {
  double largest = 0;
  for (const Rgb& value : b) largest = std::max(largest, max_abs(value));
  return largest;
}

double max_distance(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, max_abs(a[i] - b[i]));
  return largest;
}

double sum(const Rgb& value) { return value.r + value.g + value.b; }

/// Relative to `scale`, where there is any.
double share(double part, double scale) { return scale > 0 ? part / scale : 0.0; }

/// The mean of a list that gets longer (eq. 45).
struct RunningMean {
  std::vector<Rgb> sum;
  int count = 0;

  void add(const std::vector<Rgb>& values) {
    sum.resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
    ++count;
  }
  std::vector<Rgb> mean() const {
    std::vector<Rgb> mean(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i) mean[i] = (1.0 / count) * sum[i];
    return mean;
  }
};

/// What is known of the passes that a step rests on.
struct SeenAreas {
  std::vector<double> rows;       ///< sum_d sum_j A(i,j,omega_d)
  std::vector<double> columns;    ///< the same over i; two-way, these are the rows'
  std::vector<double> projected;  ///< sum_d A_i max(n_i·omega_d, 0)
  int passes = 0;

  explicit SeenAreas(std::size_t patches) : rows(patches), columns(patches), projected(patches) {}
  void add(const Transfers& transfers, bool two_way) {
    for (std::size_t i = 0; i < projected.size(); ++i) {
      projected[i] += transfers.forward[i].projected;
      if (two_way) projected[i] += transfers.backward[i].projected;
    }
    for (const Transfer& t : transfers.exchanges) {
      const auto i = static_cast<std::size_t>(t.receiver);
      const auto j = static_cast<std::size_t>(t.source);
      rows[i] += t.area;
      (two_way ? rows : columns)[j] += t.area;
    }
    ++passes;
  }
};

}  // namespace

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
  Iterate whole;
  std::vector<Iterate> replicas;

  // The steps before.
  RunningMean mean_b, mean_h;  ///< where the scheme is semi-iterative
  std::vector<RunningMean> replica_means;
  std::vector<Rgb> b, h;  ///< the answer so far
  std::vector<IterationRecord> steps;
  double last_absolute_change = 0;
  bool finished = false, converged = false;

  // Learnt from each direction once.
  SeenAreas areas;
  std::vector<ExchangeSums> sums;  ///< a replica each, or one
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
       std::shared_ptr<const DirectLight> ready_shot)
      : scene(std::move(solved)),
        options(validated(how)),
        tree(std::move(ready_tree)),
        cancellation(stop),
        plan(how),
        directions(plan.directions(0)),
        shot(std::move(ready_shot)),
        whole(*scene, how, *light_of_shot()),
        areas(static_cast<std::size_t>(scene->patch_count())) {
    threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    if (!tree) {
      const auto start = Clock::now();
      tree = std::make_shared<const BspTree>(*scene, cancellation);
      seconds_bsp = seconds_since(start);
    }
    engine = make_engine(options.engine, scene, tree, options.engine_options);
    if (options.replicas > 1) {
      for (int r = 0; r < options.replicas; ++r) replicas.emplace_back(*scene, options, *shot);
      replica_means.resize(replicas.size());
    }
    const std::uint64_t memory = options.memory ? options.memory : quarter_of_memory();
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

  static const SolveOptions& validated(const SolveOptions& options) {
    options.validate();
    return options;
  }

  /// The first shot's light; shoots where that is still to be done.
  const std::shared_ptr<const DirectLight>& light_of_shot() {
    if (!shot) {
      const auto start = Clock::now();
      std::vector<PatchId> sources;
      if (options.first_shot) sources = find_small_sources(*scene, *options.first_shot);
      shot = std::make_shared<const DirectLight>(
          shoot(*scene, sources, options.threads, cancellation));
      seconds_first_shot = seconds_since(start);
    }
    return shot;
  }

  int ways() const { return options.two_way ? 2 : 1; }
  int step() const { return static_cast<int>(steps.size()); }
  /// Passes that the step under way takes, and that it has.
  int wanted() const { return plan.passes(step()); }
  int done() const { return begun ? whole.passes() : 0; }
  bool keeps_sums() const {
    return !plan.renews() &&
           std::none_of(sums.begin(), sums.end(), [](const auto& s) { return s.overrun(); });
  }
  KeptSums all_sums() const {
    KeptSums all;
    for (const ExchangeSums& part : sums) all.push_back(&part);
    return all;
  }
  std::size_t replica_of(int k) const { return static_cast<std::size_t>(k) % sums.size(); }
  /// Calls visit(iterate, its sums) for B of all passes and of each replica's.
  template <class Visit>
  void for_each_iterate(Visit visit) {
    visit(whole, all_sums());
    for (std::size_t r = 0; r < replicas.size(); ++r) visit(replicas[r], KeptSums{&sums[r]});
  }

  /// Takes over what kept sums have of this step; the rest is left to passes.
  void begin_step() {
    const auto start = Clock::now();
    if (plan.renews() && !steps.empty()) {
      directions = plan.directions(step());
      areas = SeenAreas(b.size());
      quadrature_errors.clear();
    }
    const bool from_sums = keeps_sums() && areas.passes > 0;
    if (from_sums && options.scheme == Scheme::conjugate_gradients && steps.size() == 1) {
      for_each_iterate([&](Iterate& iterate, const KeptSums& kept) {
        iterate.leap(kept, 0.1 * options.tolerance, cancellation);
      });
    }
    for_each_iterate([&](Iterate& iterate, const KeptSums& kept) {
      cancellation.throw_if_cancelled();
      if (from_sums) {
        iterate.begin(kept);
      } else {
        iterate.begin();
      }
    });
    begun = true;
    taken_over = whole.passes();
    if (taken_over > 0) find_estimate();
    const double seconds = seconds_since(start);
    seconds_iterate += seconds;
    step_seconds += seconds;
  }

  /// Whether pass k of the step under way is the first along its direction, given that the first
  /// `known` have been learnt from. Any thread may ask.
  bool is_new(int k, int known) const { return plan.renews() || k >= known; }

  /// A pure function of k and `known`, the passes that were learnt from before.
  Pass make_pass(int k, int known) const {
    Pass pass;
    pass.transfers = engine(directions[static_cast<std::size_t>(k)], cancellation);
    if (is_new(k, known)) {
      if (!plan.renews()) pass.run = sums.front().make_run(pass.transfers.exchanges);
      pass.closure = closure_defect(pass.transfers, *scene);
    }
    return pass;
  }

  /// Adds pass k to the step under way; in order of the passes, on one thread at a time.
  void absorb(int k, Pass pass) {
    const auto start = Clock::now();
    const bool news = is_new(k, areas.passes);
    if (news && keeps_sums()) keep(k, std::move(pass.run));
    whole.add(pass.transfers);
    if (!replicas.empty()) replicas[replica_of(k)].add(pass.transfers);
    if (news) learn(pass);
    ++passes_made;
    estimate_changes.push_back(find_estimate());
    seconds_iterate += seconds_since(start);
  }

  /// What needs to be learnt from each direction only once.
  void learn(const Pass& pass) {
    const Transfers& transfers = pass.transfers;
    areas.add(transfers, options.two_way);
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

  void keep(int k, ExchangeSums::Run run) {
    sums[replica_of(k)].add(std::move(run));
    // Where one part does not fit, the others are of no use.
    if (!keeps_sums()) {
      for (ExchangeSums& part : sums) part.drop();
    }
  }

  /// Returns how much the estimate changes, relative to its largest value.
  double find_estimate() {
    double change = 0, largest = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      Rgb value = whole.estimate(static_cast<PatchId>(i));
      if (mean_b.count > 0) value = (1.0 / (mean_b.count + 1)) * (mean_b.sum[i] + value);
      change = std::max(change, max_abs(value - estimate[i]));
      largest = std::max(largest, max_abs(value));
      estimate[i] = value;
    }
    return share(change, largest);
  }

  /// B(n+1) from what was gathered, and the rule of eq. 25.
  void finish_step() {
    const auto start = Clock::now();
    if (whole.passes() > taken_over && keeps_sums()) {
      for (ExchangeSums& part : sums) part.finish();
      for_each_iterate([](Iterate& iterate, const KeptSums& kept) { iterate.keep(kept); });
    }
    if (options.normalize == Normalization::symmetric && !keeps_sums()) {
      throw std::runtime_error(
          "a symmetric normalization wants kept form factors, and they take more than --memory "
          "allows");
    }
    measure_energy();
    const bool complete = whole.passes() == options.directions;
    double absolute = whole.finish();
    for (Iterate& replica : replicas) replica.finish();
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

  /// Whether the steps so far count for nothing in the mean.
  bool in_burn_in() const { return plan.renews() && mean_b.count == 0; }

  /// The answer of the semi-iterative scheme; returns how much the step has changed it.
  double average() {
    if (step() >= options.burn_in) {
      mean_b.add(whole.b());
      mean_h.add(whole.h());
      for (std::size_t r = 0; r < replicas.size(); ++r) replica_means[r].add(replicas[r].b());
    }
    std::vector<Rgb> next = in_burn_in() ? whole.b() : mean_b.mean();
    h = in_burn_in() ? whole.h() : mean_h.mean();
    const double change = max_distance(next, b);
    b = std::move(next);
    return change;
  }

  /// Power received against power sent, before any scaling of rows (oracle 4).
  void measure_energy() {
    Rgb received;
    for (const Rgb& value : whole.gathered()) received += value;
    const Rgb sent = whole.sent(options.two_way ? areas.rows : areas.columns);
    energy_defect = share(max_abs(received - sent), max_abs(sent));
  }

  /// Too few directions for so much reflectance make rows sum to more than 1/rho.
  void check_contraction() const {
    constexpr std::size_t patience = 20;
    if (finished || steps.size() < patience) return;
    const bool growing = std::all_of(steps.end() - patience / 2, steps.end(),
                                     [](const IterationRecord& s) { return s.contraction >= 1; });
    if (growing) {
      throw NotConvergent(fmt::format(
          "the iteration does not converge: each change is {:.3g} times the one before; take more "
          "directions than {}, or --normalize rows",
          steps.back().contraction, options.directions));
    }
  }

  /// One pass on this thread.
  bool advance_direction(const RadiositySolver& self, const Observer& observer) {
    const auto start = Clock::now();
    const int k = done();
    Pass pass = make_pass(k, areas.passes);
    seconds_transfers += seconds_since(start);
    absorb(k, std::move(pass));
    step_seconds += seconds_since(start);
    return !observer || observer(self);
  }

  /// All passes that the step still lacks, over all threads; absorbed in order, so the sums are
  /// the same bits whatever the number of threads.
  bool advance_passes(const RadiositySolver& self, const Observer& observer) {
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
            if (observer && !observer(self)) going = false;
            return going;
          });
    } catch (...) {
      conclude();
      throw;
    }
    conclude();
    return going;
  }
};

RadiositySolver::RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                                 std::shared_ptr<const BspTree> tree,
                                 const Cancellation& cancellation,
                                 std::shared_ptr<const DirectLight> shot)
    : impl_(std::make_unique<Impl>(std::move(scene), options, std::move(tree), cancellation,
                                   std::move(shot))) {}
RadiositySolver::~RadiositySolver() = default;
RadiositySolver::RadiositySolver(RadiositySolver&&) noexcept = default;
RadiositySolver& RadiositySolver::operator=(RadiositySolver&&) noexcept = default;

bool RadiositySolver::advance(Until until, const Observer& observer) {
  Impl& s = *impl_;
  while (!s.finished) {
    s.cancellation.throw_if_cancelled();
    if (!s.begun) s.begin_step();
    if (s.done() < s.wanted()) {
      const bool go_on = until == Until::direction ? s.advance_direction(*this, observer)
                                                   : s.advance_passes(*this, observer);
      if (s.done() < s.wanted() && (!go_on || until == Until::direction)) return true;
    }
    s.finish_step();
    const bool go_on = !observer || observer(*this);
    if (!go_on || until != Until::finished) break;
  }
  return !s.finished;
}

const Scene& RadiositySolver::scene() const { return *impl_->scene; }
std::shared_ptr<const Scene> RadiositySolver::shared_scene() const { return impl_->scene; }
const BspTree& RadiositySolver::tree() const { return *impl_->tree; }
std::shared_ptr<const BspTree> RadiositySolver::shared_tree() const { return impl_->tree; }
const SolveOptions& RadiositySolver::options() const { return impl_->options; }

SolveProgress RadiositySolver::progress() const {
  const Impl& s = *impl_;
  SolveProgress progress;
  progress.iteration = static_cast<int>(s.steps.size());
  progress.direction = s.done();
  progress.passes = s.finished ? s.plan.passes(s.step() - 1) : s.wanted();
  progress.finished = s.finished;
  progress.seconds_transfers = s.seconds_transfers;
  if (s.done() > s.taken_over && s.step_seconds > 0) {
    progress.passes_per_second = (s.done() - s.taken_over) / s.step_seconds;
    progress.seconds_left = (progress.passes - s.done()) / progress.passes_per_second;
  }
  if (s.done() > 0) {
    progress.last_direction = s.directions[static_cast<std::size_t>(s.done() - 1)];
  } else if (!s.steps.empty()) {
    progress.last_direction =
        s.directions[static_cast<std::size_t>(s.plan.passes(s.step() - 1) - 1)];
  }
  return progress;
}

const std::vector<Vec3>& RadiositySolver::directions() const { return impl_->directions; }

SolveStatistics RadiositySolver::statistics() const {
  const Impl& s = *impl_;
  SolveStatistics statistics;
  statistics.patches = s.scene->patch_count();
  statistics.fragments = static_cast<std::int64_t>(s.tree->fragments().size());
  statistics.directions = s.options.directions * s.ways();
  statistics.passes = s.options.directions;
  statistics.passes_made = s.passes_made;
  statistics.iterations = static_cast<int>(s.steps.size());
  statistics.threads = s.threads;
  statistics.transfers = s.transfer_count;
  statistics.counts = s.counts;
  statistics.kept_form_factors = s.keeps_sums();
  for (const ExchangeSums& part : s.sums) {
    statistics.form_factors += static_cast<std::int64_t>(part.size());
  }
  statistics.converged = s.converged;
  statistics.closure_defect_max = s.closure_relative;
  statistics.closure_defect_grazing = s.closure_grazing;
  statistics.escaped = share(std::max(0.0, s.seen - s.covered), s.seen);
  statistics.energy_defect = s.energy_defect;
  double absorbed = 0, emitted = 0;
  for (PatchId i = 0; i < s.scene->patch_count(); ++i) {
    const double area = s.scene->patch(i).area;
    const Rgb& rho = s.scene->reflectance(i);
    absorbed += area * sum((Rgb{1, 1, 1} - rho) * s.h[static_cast<std::size_t>(i)]);
    emitted += area * sum(s.scene->exitance(i));
    statistics.rho_max = std::max(statistics.rho_max, max_abs(rho));
  }
  statistics.energy_balance = share(absorbed, emitted);
  statistics.predicted_contraction =
      contraction_bound(statistics.rho_max, quadrature_error_bound(statistics.directions));
  statistics.steps = s.steps;
  statistics.shot_sources = static_cast<std::int64_t>(s.shot->sources.size());
  statistics.shot_power_share = s.shot->power_share;
  statistics.seconds_bsp = s.seconds_bsp;
  statistics.seconds_first_shot = s.seconds_first_shot;
  statistics.seconds_transfers = s.seconds_transfers;
  statistics.seconds_iterate = s.seconds_iterate;
  statistics.seconds_total =
      s.seconds_bsp + s.seconds_first_shot + s.seconds_transfers + s.seconds_iterate;
  return statistics;
}

const std::vector<Rgb>& RadiositySolver::radiosity() const { return impl_->b; }
const std::vector<Rgb>& RadiositySolver::irradiance() const { return impl_->h; }
const std::vector<double>& RadiositySolver::estimate_changes() const {
  return impl_->estimate_changes;
}
const std::vector<double>& RadiositySolver::quadrature_errors() const {
  return impl_->quadrature_errors;
}
std::vector<Rgb> RadiositySolver::running_estimate() const { return impl_->estimate; }

FormFactors RadiositySolver::form_factors() const {
  const Impl& s = *impl_;
  if (s.plan.renews()) {
    throw std::runtime_error("the semi-iterative scheme keeps no form factors");
  }
  if (s.steps.empty() || s.begun) throw std::runtime_error("there are no form factors yet");
  if (!s.keeps_sums()) {
    throw std::runtime_error("the form factors take more than --memory allows");
  }
  // Several lists of sums become one.
  ExchangeSums joined(s.scene->patch_count(), s.options.two_way, ~std::uint64_t{0}, s.cancellation);
  if (s.sums.size() > 1) {
    for (const ExchangeSums& part : s.sums) {
      ExchangeSums::Run run;
      run.reserve(part.size());
      part.for_each([&](PatchId i, PatchId j, double area) { run.push_back({i, j, area}); });
      joined.add(std::move(run));
    }
    joined.finish();
  }
  const ExchangeSums& sums = s.sums.size() > 1 ? joined : s.sums.front();
  // Rows are filled in the order of the pairs, first with what lies left of the diagonal: so their
  // sources rise.
  const bool two_way = s.options.two_way;
  FormFactors result;
  result.row_begin.resize(s.b.size() + 1);
  sums.for_each([&](PatchId i, PatchId j, double) {
    ++result.row_begin[static_cast<std::size_t>(i) + 1];
    if (two_way) ++result.row_begin[static_cast<std::size_t>(j) + 1];
  });
  std::partial_sum(result.row_begin.begin(), result.row_begin.end(), result.row_begin.begin());
  result.source.resize(result.row_begin.back());
  result.value.resize(result.row_begin.back());
  std::vector<std::size_t> next(result.row_begin.begin(), result.row_begin.end() - 1);
  const auto put = [&](PatchId i, PatchId j, double area) {
    const std::size_t k = next[static_cast<std::size_t>(i)]++;
    result.source[k] = j;
    result.value[k] = s.whole.form_factor_scale(i, j) * area;
  };
  if (two_way) sums.for_each([&](PatchId i, PatchId j, double area) { put(j, i, area); });
  sums.for_each(put);
  return result;
}

std::vector<double> RadiositySolver::form_factor_sums() const {
  const Impl& s = *impl_;
  std::vector<double> form_factor_sums(s.areas.rows.size());
  if (s.areas.passes == 0) return form_factor_sums;
  for (std::size_t i = 0; i < form_factor_sums.size(); ++i) {
    form_factor_sums[i] = s.whole.form_factor_sum(static_cast<PatchId>(i), s.areas.rows[i],
                                                  s.areas.projected[i], s.areas.passes);
  }
  return form_factor_sums;
}

ErrorEstimate RadiositySolver::error_estimate() const {
  const Impl& s = *impl_;
  if (s.replicas.empty()) return {};
  // The answer of the semi-iterative scheme is a mean, and so is that of its replicas.
  const bool averaged = s.mean_b.count > 0;
  const bool under_way = s.begun && !averaged;
  std::vector<std::vector<Rgb>> b;
  for (std::size_t r = 0; r < s.replicas.size(); ++r) {
    const Iterate& replica = s.replicas[r];
    if (under_way && replica.passes() == 0) return {};
    b.push_back(averaged ? s.replica_means[r].mean() : replica.b());
    if (!under_way) continue;
    for (PatchId i = 0; i < s.scene->patch_count(); ++i) {
      b.back()[static_cast<std::size_t>(i)] = replica.estimate(i);
    }
  }
  return estimate_error(*s.scene, under_way ? s.estimate : s.b, b);
}

Vec3 RadiositySolver::direction(int iteration, int pass) const {
  const Impl& s = *impl_;
  const auto k = static_cast<std::size_t>(pass);
  return s.plan.renews() ? s.plan.directions(iteration).at(k) : s.directions.at(k);
}

std::vector<double> RadiositySolver::back_seen_shares() const {
  const Impl& s = *impl_;
  std::vector<double> shares(s.back_seen.size());
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] = share(s.back_seen[i], s.facing_area[i]);
  return shares;
}

Solution solve(std::shared_ptr<const Scene> scene, const SolveOptions& options,
               const RadiositySolver::Observer& observer, const Cancellation& cancellation) {
  const auto start = Clock::now();
  RadiositySolver solver(std::move(scene), options, nullptr, cancellation);
  Solution solution;
  solution.scene = solver.shared_scene();
  try {
    while (solver.advance(RadiositySolver::Until::finished, observer)) {
      // A pause asked for by the observer of a plain solve is the end of it.
      if (observer) break;
    }
  } catch (const Cancelled&) {
  }
  const SolveProgress progress = solver.progress();
  solution.complete = progress.finished;
  solution.radiosity = progress.direction > 0 ? solver.running_estimate() : solver.radiosity();
  solution.irradiance = solver.irradiance();
  solution.error = solver.error_estimate();
  solution.statistics = solver.statistics();
  solution.statistics.seconds_total = seconds_since(start);
  return solution;
}

}  // namespace transillum
