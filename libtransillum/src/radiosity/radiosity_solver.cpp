// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "radiosity/exchange_sums.h"
#include "radiosity/hand_over.h"
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

/// eps(M) by eq. 21.
double quadrature_error_bound(double directions) {
  return 2 * std::numbers::pi / directions * (std::log2(directions) + 7);
}

/// Stands for what a solver has done before its workers start: an address that they know without
/// reading anything.
constexpr char start_of_passes = 0;

/// What a worker makes of one direction.
struct Pass {
  Transfers transfers;
  ExchangeSums::Run run;
  ClosureDefect closure;
};

}  // namespace

struct RadiositySolver::Impl {
  // What is solved.
  std::shared_ptr<const Scene> scene;
  SolveOptions options;
  std::shared_ptr<const BspTree> tree;
  Cancellation cancellation;
  TransferEngine engine;
  std::vector<Vec3> directions;  ///< in the order of the passes
  int threads = 1;

  // The step under way: sums over its passes so far.
  int done = 0;
  std::vector<Rgb> gathered;      ///< sum_d sum_j A(i,j,omega_d) B_j
  std::vector<double> projected;  ///< sum_d A_i max(n_i·omega_d, 0)
  std::vector<Rgb> estimate;      ///< of B, from these
  std::vector<double> estimate_changes;
  double step_seconds = 0;

  // The steps before.
  std::vector<Rgb> b, h;
  std::vector<IterationRecord> steps;
  double last_absolute_change = 0;
  bool finished = false, converged = false;

  // Known once the first step's passes are done.
  std::vector<double> row_areas;     ///< sum_d sum_j A(i,j,omega_d)
  std::vector<double> column_areas;  ///< the same over i; two-way, these are the rows'
  std::vector<double> first_projected, facing_area, back_seen;
  int first_done = 0;
  ExchangeSums sums;
  double closure_relative = 0, closure_grazing = 0, covered = 0, seen = 0;
  double energy_defect = 0;
  std::int64_t transfer_count = 0;
  PassCounts counts;
  double seconds_bsp = 0, seconds_transfers = 0, seconds_iterate = 0;

  Impl(std::shared_ptr<const Scene> solved, const SolveOptions& how,
       std::shared_ptr<const BspTree> ready_tree, const Cancellation& stop)
      : scene(std::move(solved)),
        options(how),
        tree(std::move(ready_tree)),
        cancellation(stop),
        sums(scene->patch_count(), how.two_way, how.memory ? how.memory : quarter_of_memory(),
             stop) {
    options.validate();
    auto samples = make_directions(options.sampling, options.directions, options.seed);
    if (options.rotation) samples = rotated(std::move(samples), *options.rotation);
    for (const int k : progressive_order(options.sampling, options.directions)) {
      directions.push_back(samples[static_cast<std::size_t>(k)].direction);
    }
    threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    if (!tree) {
      const auto start = Clock::now();
      tree = std::make_shared<const BspTree>(*scene, cancellation);
      seconds_bsp = seconds_since(start);
    }
    engine = make_engine(options.engine, scene, tree, options.engine_options);

    const auto patches = static_cast<std::size_t>(scene->patch_count());
    for (PatchId i = 0; i < scene->patch_count(); ++i) b.push_back(scene->exitance(i));
    h.resize(patches);
    gathered.resize(patches);
    projected.resize(patches);
    estimate = b;
    row_areas.resize(patches);
    column_areas.resize(patches);
    facing_area.resize(patches);
    back_seen.resize(patches);
  }

  bool in_first_step() const { return steps.empty(); }
  /// Whether the step under way comes from kept sums, without passes.
  bool from_sums() const { return !in_first_step() && !sums.overrun(); }
  int ways() const { return options.two_way ? 2 : 1; }

  /// A pure function of k and `first`, that is of what no pass changes: any thread may.
  Pass make_pass(int k, bool first) const {
    Pass pass;
    pass.transfers = engine(directions[static_cast<std::size_t>(k)], cancellation);
    if (first) {
      pass.run = sums.make_run(pass.transfers.exchanges);
      pass.closure = closure_defect(pass.transfers, *scene);
    }
    return pass;
  }

  /// Adds a pass to the step under way; in order of the passes, on one thread at a time.
  void absorb(Pass pass) {
    const auto start = Clock::now();
    if (in_first_step()) sums.add(std::move(pass.run));
    const Transfers& transfers = pass.transfers;
    for (const Transfer& t : transfers.exchanges) {
      const auto i = static_cast<std::size_t>(t.receiver);
      const auto j = static_cast<std::size_t>(t.source);
      gathered[i] += t.area * b[j];
      if (options.two_way) gathered[j] += t.area * b[i];
    }
    for (std::size_t i = 0; i < projected.size(); ++i) {
      projected[i] += transfers.forward[i].projected;
      if (options.two_way) projected[i] += transfers.backward[i].projected;
    }
    if (in_first_step()) absorb_first(pass);
    ++done;
    update_estimate();
    seconds_iterate += seconds_since(start);
  }

  /// What needs to be learnt from each direction only once.
  void absorb_first(const Pass& pass) {
    const Transfers& transfers = pass.transfers;
    for (const Transfer& t : transfers.exchanges) {
      const auto i = static_cast<std::size_t>(t.receiver);
      const auto j = static_cast<std::size_t>(t.source);
      row_areas[i] += t.area;
      (options.two_way ? row_areas : column_areas)[j] += t.area;
    }
    for (std::size_t i = 0; i < projected.size(); ++i) {
      const Coverage& forward = transfers.forward[i];
      const Coverage& backward = transfers.backward[i];
      facing_area[i] += forward.projected + backward.projected;
      back_seen[i] += transfers.back_seen[i];
      seen += forward.projected + backward.projected;
      covered += forward.covered + backward.covered;
    }
    closure_relative = std::max(closure_relative, pass.closure.relative);
    closure_grazing = std::max(closure_grazing, pass.closure.grazing);
    counts += transfers.counts;
    transfer_count += static_cast<std::int64_t>(transfers.exchanges.size());
  }

  /// What turns gathered_i into the irradiance H_i.
  double row_scale(std::size_t i, const std::vector<double>& projections, int passes) const {
    if (options.normalize == Normalization::rows) {
      return projections[i] > 0 ? 1 / projections[i] : 0.0;
    }
    return 4.0 / (passes * ways() * scene->patches()[i].area);
  }

  void update_estimate() {
    double change = 0, largest = 0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      const auto id = static_cast<PatchId>(i);
      const Rgb value = scene->exitance(id) +
                        scene->reflectance(id) * (row_scale(i, projected, done) * gathered[i]);
      change = std::max(change, max_abs(value - estimate[i]));
      largest = std::max(largest, max_abs(value));
      estimate[i] = value;
    }
    estimate_changes.push_back(share(change, largest));
  }

  void begin_step() {
    done = 0;
    std::fill(gathered.begin(), gathered.end(), Rgb{});
    std::fill(projected.begin(), projected.end(), 0.0);
    estimate_changes.clear();
    estimate = b;
    step_seconds = 0;
  }

  /// B(n+1) from what was gathered, and the rule of eq. 25.
  void finish_step() {
    if (in_first_step()) {
      const auto start = Clock::now();
      sums.finish();
      seconds_iterate += seconds_since(start);
      first_projected = projected;
      first_done = done;
    }
    std::vector<Rgb> next(b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
      const auto id = static_cast<PatchId>(i);
      h[i] = row_scale(i, first_projected, first_done) * gathered[i];
      next[i] = scene->exitance(id) + scene->reflectance(id) * h[i];
    }
    measure_energy();
    const double absolute = max_distance(next, b);
    IterationRecord record;
    record.change = share(absolute, max_norm(next));
    record.contraction = steps.empty() ? 0.0 : share(absolute, last_absolute_change);
    record.seconds = step_seconds;
    last_absolute_change = absolute;
    b = std::move(next);
    steps.push_back(record);
    converged = record.change <= options.tolerance;
    finished =
        options.iterations > 0 ? static_cast<int>(steps.size()) >= options.iterations : converged;
    begin_step();
    check_contraction();
  }

  /// Power received against power sent, before any scaling of rows (oracle 4).
  void measure_energy() {
    Rgb received, sent;
    const auto& columns = options.two_way ? row_areas : column_areas;
    for (std::size_t i = 0; i < b.size(); ++i) {
      received += gathered[i];
      sent += columns[i] * b[i];
    }
    energy_defect = share(max_abs(received - sent), max_abs(sent));
  }

  /// Too few directions for so much reflectance make rows sum to more than 1/rho.
  void check_contraction() const {
    constexpr std::size_t patience = 20;
    if (finished || steps.size() < patience) return;
    const bool growing = std::all_of(steps.end() - patience / 2, steps.end(),
                                     [](const IterationRecord& s) { return s.contraction >= 1; });
    if (growing) {
      throw std::runtime_error(fmt::format(
          "the iteration does not converge: each change is {:.3g} times the one before; take more "
          "directions than {}, or --normalize rows",
          steps.back().contraction, options.directions));
    }
  }

  /// One pass on this thread.
  bool advance_direction(const RadiositySolver& self, const Observer& observer) {
    const auto start = Clock::now();
    Pass pass = make_pass(done, in_first_step());
    const double engine_seconds = seconds_since(start);
    seconds_transfers += engine_seconds;
    absorb(std::move(pass));
    step_seconds += seconds_since(start);
    return !observer || observer(self);
  }

  /// All passes that the step still lacks, over all threads; absorbed in order, so the sums are
  /// the same bits whatever the number of threads.
  bool advance_passes(const RadiositySolver& self, const Observer& observer) {
    const int passes = options.directions;
    std::atomic<bool> going{true};
    int next = done;
    auto last = Clock::now();
    double absorbing = -seconds_iterate;
    double wall = 0;
    // Passes under way have places that they take in turn: at most as many are let in, and they
    // leave in order, so a pass finds its place left by the one before it there.
    std::vector<Pass> under_way(static_cast<std::size_t>(2 * threads));
    const auto place_of = [&](int k) {
      return &under_way[static_cast<std::size_t>(k) % under_way.size()];
    };
    const auto source = [&](tbb::flow_control& control) {
      take_over_at(&start_of_passes);
      const Turn turn(&next);
      if (next >= passes || !going) {
        control.stop();
        return passes;
      }
      const Turn handed_on(place_of(next));
      return next++;
    };
    const bool first = in_first_step();
    const auto work = [&, first](int k) {
      take_over_at(&start_of_passes);
      const Turn turn(place_of(k));
      *place_of(k) = make_pass(k, first);
      return k;
    };
    const auto sink = [&](int k) {
      take_over_at(&start_of_passes);
      const Turn turn(this), handed_on(place_of(k));
      absorb(std::move(*place_of(k)));
      const double now = seconds_since(last);
      last = Clock::now();
      wall += now;
      step_seconds += now;
      if (observer && !observer(self)) going = false;
    };
    const auto conclude = [&] {
      take_over_at(&next);
      take_over_at(this);
      for (const Pass& place : under_way) take_over_at(&place);
      absorbing += seconds_iterate;
      seconds_transfers += std::max(0.0, wall - absorbing / threads);
    };
    // More threads than cores, where that is asked for, need the permission.
    const tbb::global_control permission(tbb::global_control::max_allowed_parallelism,
                                         static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    const auto filters = tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, source) &
                         tbb::make_filter<int, int>(tbb::filter_mode::parallel, work) &
                         tbb::make_filter<int, void>(tbb::filter_mode::serial_in_order, sink);
    hand_over_at(&start_of_passes);
    try {
      arena.execute([&] { tbb::parallel_pipeline(under_way.size(), filters); });
    } catch (...) {
      conclude();
      throw;
    }
    conclude();
    return going;
  }

  /// A step without passes, from the kept sums.
  void gather_from_sums() {
    const auto start = Clock::now();
    sums.gather(b, gathered);
    const double seconds = seconds_since(start);
    seconds_iterate += seconds;
    step_seconds += seconds;
  }
};

RadiositySolver::RadiositySolver(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                                 std::shared_ptr<const BspTree> tree,
                                 const Cancellation& cancellation)
    : impl_(std::make_unique<Impl>(std::move(scene), options, std::move(tree), cancellation)) {}
RadiositySolver::~RadiositySolver() = default;
RadiositySolver::RadiositySolver(RadiositySolver&&) noexcept = default;
RadiositySolver& RadiositySolver::operator=(RadiositySolver&&) noexcept = default;

bool RadiositySolver::advance(Until until, const Observer& observer) {
  Impl& s = *impl_;
  while (!s.finished) {
    s.cancellation.throw_if_cancelled();
    if (s.from_sums()) {
      s.gather_from_sums();
    } else if (s.done < s.options.directions) {
      const bool go_on = until == Until::direction ? s.advance_direction(*this, observer)
                                                   : s.advance_passes(*this, observer);
      if (s.done < s.options.directions && (!go_on || until == Until::direction)) return true;
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
  progress.direction = s.done;
  progress.passes = s.options.directions;
  progress.finished = s.finished;
  progress.seconds_transfers = s.seconds_transfers;
  if (s.done > 0 && s.step_seconds > 0) {
    progress.passes_per_second = s.done / s.step_seconds;
    progress.seconds_left = (s.options.directions - s.done) / progress.passes_per_second;
  }
  const int newest = s.done > 0 ? s.done - 1 : s.options.directions - 1;
  if (s.done > 0 || !s.steps.empty()) {
    progress.last_direction = s.directions[static_cast<std::size_t>(newest)];
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
  statistics.iterations = static_cast<int>(s.steps.size());
  statistics.threads = s.threads;
  statistics.transfers = s.transfer_count;
  statistics.counts = s.counts;
  statistics.kept_form_factors = !s.sums.overrun();
  statistics.form_factors = static_cast<std::int64_t>(s.sums.size());
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
      statistics.rho_max * (1 + quadrature_error_bound(statistics.directions) / std::numbers::pi);
  statistics.steps = s.steps;
  statistics.seconds_bsp = s.seconds_bsp;
  statistics.seconds_transfers = s.seconds_transfers;
  statistics.seconds_iterate = s.seconds_iterate;
  statistics.seconds_total = s.seconds_bsp + s.seconds_transfers + s.seconds_iterate;
  return statistics;
}

const std::vector<Rgb>& RadiositySolver::radiosity() const { return impl_->b; }
const std::vector<Rgb>& RadiositySolver::irradiance() const { return impl_->h; }
const std::vector<double>& RadiositySolver::estimate_changes() const {
  return impl_->estimate_changes;
}
std::vector<Rgb> RadiositySolver::running_estimate() const { return impl_->estimate; }

FormFactors RadiositySolver::form_factors() const {
  const Impl& s = *impl_;
  if (s.in_first_step()) throw std::runtime_error("there are no form factors yet");
  if (s.sums.overrun()) {
    throw std::runtime_error("the form factors take more than --memory allows");
  }
  // Rows are filled in the order of the pairs, first with what lies left of the diagonal: so their
  // sources rise.
  const bool two_way = s.options.two_way;
  FormFactors result;
  result.row_begin.resize(s.b.size() + 1);
  s.sums.for_each([&](PatchId i, PatchId j, double) {
    ++result.row_begin[static_cast<std::size_t>(i) + 1];
    if (two_way) ++result.row_begin[static_cast<std::size_t>(j) + 1];
  });
  std::partial_sum(result.row_begin.begin(), result.row_begin.end(), result.row_begin.begin());
  result.source.resize(result.row_begin.back());
  result.value.resize(result.row_begin.back());
  std::vector<std::size_t> next(result.row_begin.begin(), result.row_begin.end() - 1);
  const auto put = [&](PatchId i, PatchId j, double area) {
    const auto row = static_cast<std::size_t>(i);
    const std::size_t k = next[row]++;
    result.source[k] = j;
    result.value[k] = s.row_scale(row, s.first_projected, s.first_done) * area;
  };
  if (two_way) s.sums.for_each([&](PatchId i, PatchId j, double area) { put(j, i, area); });
  s.sums.for_each(put);
  return result;
}

std::vector<double> RadiositySolver::form_factor_sums() const {
  const Impl& s = *impl_;
  const bool first = s.in_first_step();
  const int passes = first ? s.done : s.first_done;
  std::vector<double> form_factor_sums(s.row_areas.size());
  if (passes == 0) return form_factor_sums;
  for (std::size_t i = 0; i < form_factor_sums.size(); ++i) {
    form_factor_sums[i] =
        s.row_scale(i, first ? s.projected : s.first_projected, passes) * s.row_areas[i];
  }
  return form_factor_sums;
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
  solution.statistics = solver.statistics();
  solution.statistics.seconds_total = seconds_since(start);
  return solution;
}

}  // namespace transillum
