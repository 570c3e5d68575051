// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The order of rounds, stages and passes of a solve. Input: a scene and options; output: a Solution
// at any time.
#include "transillum/solve_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/seconds_since.h"
#include "base/worker_threads.h"
#include "radiosity/exchange/sums_in_memory.h"
#include "radiosity/solver/solver_input.h"
#include "scene/build/patch_count.h"
#include "session/session_state.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using SolverUntil = RadiositySolver::Until;

}  // namespace

SolveSession::Impl::Impl(SolveRequest solve_request, const Cancellation& solve_cancellation)
    : request(std::move(solve_request)), cancellation(solve_cancellation) {
  if (!request.sums) {
    request.sums = sums_in_memory();
  }
  request.options.validate();
  if (!takes_directions(request.options.engine)) {
    throw InputError(fmt::format("engine {} makes no passes", name_of(request.options.engine)));
  }
  if (request.refine) {
    rounds.emplace(request.scene, request.options, *request.refine, cancellation);
  }
  begin(rounds ? rounds->scene() : request.scene);
}

double SolveSession::Impl::seconds() const {
  return seconds_before + (called ? seconds_since(*called) : 0.0);
}

void SolveSession::Impl::begin(const std::shared_ptr<const Scene>& solved) {
  solver.reset();
  next.reset();
  best.reset();
  assessed = false;
  plan.reset();
  scene = solved;
  tree = scene == request.scene ? request.tree : nullptr;
  shot = scene == request.scene ? request.shot : nullptr;
  seconds_bsp = seconds_first_shot = seconds_before = 0;
  if (called) {
    called = Clock::now();
  }
  if (request.options.goal.is_set()) {
    plan.emplace(request.options, *scene);
  }
}

void SolveSession::Impl::build_tree(const Cancellation& interruption) {
  if (tree) {
    return;
  }
  const auto start = Clock::now();
  std::function<void(double)> report;
  if (request.preparing) {
    report = [this](double fraction) { request.preparing(Preparation::tree, fraction); };
    report(0);
  }
  tree = std::make_shared<const BspTree>(*scene, interruption, report, request.options.threads);
  seconds_bsp = seconds_since(start);
}

void SolveSession::Impl::shoot_first(const Cancellation& interruption) {
  const SolveOptions& options = plan ? plan->stage() : request.options;
  const std::vector<int> points = plan ? plan->shot_points() : std::vector<int>();
  if (!options.used_first_shot() || (shot && (points.empty() || shot->points == points))) {
    return;
  }
  const auto start = Clock::now();
  std::function<void(double)> report;
  if (request.preparing) {
    report = [this](double fraction) { request.preparing(Preparation::first_shot, fraction); };
    report(0);
  }
  if (!shot) {
    shot = std::make_shared<const DirectLight>(first_shot(*scene, options, interruption, report));
  }
  if (!points.empty()) {
    shot = std::make_shared<const DirectLight>(
        refined_shot(*scene, options, *shot, points, interruption, report));
  }
  seconds_first_shot += seconds_since(start);
}

void SolveSession::Impl::make_solver() {
  const SolveOptions& options = plan ? plan->stage() : request.options;
  if (options.glossy && has_lobes(*scene)) {
    solver.emplace(GlossySolver(scene, options,
                                {.tree = tree, .shot = shot, .engine = request.engine, .sums = {}},
                                cancellation));
    return;
  }
  solver.emplace(RadiositySolver(
      scene, options, {.tree = tree, .shot = shot, .engine = request.engine, .sums = request.sums},
      cancellation));
  if (request.keep_form_factors) {
    solver->diffuse()->keep_form_factors();
  }
}

void SolveSession::Impl::prepare(const Cancellation& interruption) {
  if (solver) {
    return;
  }
  request.sums->agree([&] {
    interruption.throw_if_canceled();
    check_memory(scene->name(), scene->patch_count(), request.options.replicas,
                 request.options.basis == Basis::linear ? 3 : 1);
    build_tree(interruption);
    shoot_first(interruption);
  });
  make_solver();
}

bool SolveSession::Impl::advance_stage(SolverUntil until, const std::function<bool()>& observer) {
  const double most_seconds = best ? request.options.goal.seconds : 0;
  bool late = false;
  bool unfinished = true;
  try {
    unfinished = solver->advance(until, [&] {
      late = most_seconds > 0 && seconds() > most_seconds;
      const bool going = !observer || observer();
      return going && !late;
    });
  } catch (const NotConvergent&) {
    if (!plan || !plan->enlarge()) {
      throw;
    }
    next = AccuracyPlan::Next::stage;
    return false;
  }
  if (unfinished && most_seconds > 0 && request.sums->any(late)) {
    plan->end_late();
    next = AccuracyPlan::Next::done;
    return false;
  }
  return unfinished;
}

bool SolveSession::Impl::begin_next() {
  if (plan && !next) {
    best = solver->solution();
    next = plan->next({.scene = *scene,
                       .options = solver->options(),
                       .radiosity = best->radiosity,
                       .statistics = best->statistics,
                       .error = best->error,
                       .shot = shot.get(),
                       .seconds_preparing = request.sums->from_first(
                           seconds_bsp + best->statistics.seconds_bsp + seconds_first_shot),
                       .seconds_first_shot = request.sums->from_first(seconds_first_shot)},
                      request.sums->from_first(seconds()));
  }
  if (plan && next != AccuracyPlan::Next::done) {
    if (next == AccuracyPlan::Next::replica) {
      solver->diffuse()->add_replica();
    } else {
      solver.reset();
    }
    next.reset();
    return true;
  }
  if (!in_rounds()) {
    return false;
  }
  if (!assessed) {
    rounds->assess(best ? *best : solver->solution(), seconds(), cancellation);
    assessed = true;
  }
  rounds->divide_worst(cancellation);
  begin(rounds->scene());
  return true;
}

SolveSession::SolveSession(SolveRequest request, const Cancellation& cancellation)
    : impl_(std::make_unique<Impl>(std::move(request), cancellation)) {}
SolveSession::~SolveSession() = default;
SolveSession::SolveSession(SolveSession&&) noexcept = default;
SolveSession& SolveSession::operator=(SolveSession&&) noexcept = default;

void SolveSession::prepare() { prepare(impl_->cancellation); }

void SolveSession::prepare(const Cancellation& interruption) {
  const Impl::Call call(*impl_);
  impl_->prepare(interruption);
}

bool SolveSession::is_prepared() const { return impl_->solver.has_value(); }

bool SolveSession::advance(Until until, const Observer& observer) {
  Impl& s = *impl_;
  const Impl::Call call(s);
  const SolverUntil where = until == Until::direction   ? SolverUntil::direction
                            : until == Until::iteration ? SolverUntil::iteration
                                                        : SolverUntil::finished;
  bool going = true;
  while (going && !s.finished) {
    s.prepare(s.cancellation);
    const auto watch = [&] { return going = !observer || observer(*this); };
    if (s.advance_stage(where, watch)) {
      return true;
    }
    s.finished = !s.begin_next();
    going = going && until == Until::finished;
  }
  return !s.finished;
}

bool SolveSession::advance_to(std::int64_t passes, const Observer& observer) {
  while (in_rounds()) {
    bool going = true;
    advance(Until::stage,
            [&](const SolveSession& session) { return going = !observer || observer(session); });
    if (!going) {
      return true;
    }
  }
  if (!finished()) {
    prepare();
  }
  // The solver finishes the passes that run on other threads before it pauses, or its group of
  // passes: it is stopped early enough, and makes the last passes one by one.
  const int at_once = diffuse() != nullptr ? 2 : 4;  // by each thread
  const std::int64_t margin = std::int64_t{at_once} * std::max(statistics().threads, 1);
  bool going = true;
  const SolverUntil all = SolverUntil::finished, one = SolverUntil::direction;
  const auto advance_below = [&](std::int64_t target, SolverUntil until) {
    const Impl::Call call(*impl_);
    const bool in_stage = impl_->advance_stage(until, [&] {
      going = !observer || observer(*this);
      return going && passes_done() < target;
    });
    if (!in_stage) {
      impl_->finished = !impl_->begin_next();
    }
    return in_stage;
  };
  bool in_stage = !finished();
  if (in_stage && passes_done() < passes - margin) {
    in_stage = advance_below(passes - margin, all);
  }
  while (in_stage && going && passes_done() < passes) {
    in_stage = advance_below(passes, one);
  }
  return !finished();
}

void SolveSession::relight(const std::vector<Material>& materials,
                           const std::vector<std::int32_t>& of_patch) {
  if (!is_prepared() || impl_->solver->glossy() == nullptr) {
    throw std::logic_error("relight: no lobes take part in the solve");
  }
  impl_->solver->glossy()->set_materials(materials, of_patch, GlossySolver::Start::current);
  impl_->finished = false;
}

bool SolveSession::has_result() const {
  return impl_->best || (is_prepared() && passes_done() > 0);
}

bool SolveSession::finished() const { return impl_->finished; }
const std::shared_ptr<const Scene>& SolveSession::scene() const { return impl_->scene; }
const std::shared_ptr<const BspTree>& SolveSession::tree() const { return impl_->tree; }
const std::shared_ptr<PatchSums>& SolveSession::sums() const { return impl_->request.sums; }
bool SolveSession::in_rounds() const { return impl_->in_rounds(); }

const std::vector<RefinementRound>& SolveSession::rounds() const {
  static const std::vector<RefinementRound> none;
  return impl_->rounds ? impl_->rounds->rounds() : none;
}

const std::shared_ptr<const Scene>& SolveSession::refined_scene() const {
  return impl_->rounds ? impl_->rounds->refined() : impl_->scene;
}

std::vector<std::string> SolveSession::divisions() const {
  return impl_->rounds ? impl_->rounds->divisions() : std::vector<std::string>();
}

std::optional<AccuracyReport> SolveSession::accuracy() const {
  return impl_->plan ? std::optional(impl_->plan->report()) : std::nullopt;
}

double SolveSession::seconds() const { return impl_->seconds(); }

const RadiositySolver* SolveSession::diffuse() const { return impl_->solver->diffuse(); }
const GlossySolver* SolveSession::glossy() const { return impl_->solver->glossy(); }
const SolveOptions& SolveSession::options() const { return impl_->solver->options(); }
SolveProgress SolveSession::progress() const { return impl_->solver->progress(); }

std::int64_t SolveSession::passes_done() const {
  const SolveProgress now = progress();
  std::int64_t passes = now.direction;
  for (int n = 0; n < now.iteration; ++n) {
    passes += passes_of(n);
  }
  return passes;
}

SolveStatistics SolveSession::statistics() const {
  const Impl& s = *impl_;
  SolveStatistics statistics = s.solver->statistics();
  statistics.refinement = rounds();
  statistics.seconds_total += s.seconds_bsp + s.seconds_first_shot;
  statistics.seconds_bsp += s.seconds_bsp;
  statistics.seconds_first_shot += s.seconds_first_shot;
  return statistics;
}

const std::vector<Vec3>& SolveSession::directions() const { return impl_->solver->directions(); }
std::vector<Vec3> SolveSession::directions_of(int iteration) const {
  return impl_->solver->directions_of(iteration);
}
int SolveSession::passes_of(int iteration) const { return impl_->solver->passes_of(iteration); }
std::vector<Rgb> SolveSession::radiosity() const { return impl_->solver->radiosity(); }
std::vector<Rgb> SolveSession::running_estimate() const {
  return diffuse() != nullptr ? diffuse()->running_estimate() : radiosity();
}
std::vector<LinearTerm> SolveSession::linear_terms() const {
  return diffuse() != nullptr ? diffuse()->linear_terms() : std::vector<LinearTerm>();
}
std::vector<double> SolveSession::estimate_changes() const {
  return diffuse() != nullptr ? diffuse()->estimate_changes() : std::vector<double>();
}
ErrorEstimate SolveSession::error_estimate() const { return impl_->solver->error_estimate(); }

Solution SolveSession::solution() const {
  const Impl& s = *impl_;
  Solution solution = s.best ? *s.best : s.solver->solution();
  solution.complete = solution.complete && s.finished;
  solution.accuracy = accuracy();
  SolveStatistics& statistics = solution.statistics;
  statistics.refinement = rounds();
  statistics.seconds_bsp += s.seconds_bsp;
  statistics.seconds_first_shot = s.seconds_first_shot;
  statistics.seconds_total = s.seconds();
  return solution;
}

Solution solve(std::shared_ptr<const Scene> scene, const SolveOptions& options,
               const SolveSession::Observer& observer, const Cancellation& cancellation,
               const std::shared_ptr<PatchSums>& sums) {
  SolveSession session({.scene = std::move(scene), .options = options, .sums = sums}, cancellation);
  try {
    session.advance(SolveSession::Until::finished, observer);
  } catch (const Canceled&) {
    if (!session.has_result()) {
      throw;
    }
  }
  return session.solution();
}

Refinement refine(std::shared_ptr<const Scene> scene, const SolveOptions& options,
                  const RefineOptions& refine, const SolveSession::Observer& observer,
                  const Cancellation& cancellation) {
  SolveSession session({.scene = std::move(scene), .options = options, .refine = refine},
                       cancellation);
  bool going = true;
  const auto watch = [&](const SolveSession& watched) {
    return going = !observer || observer(watched);
  };
  while (going && session.in_rounds()) {
    session.advance(SolveSession::Until::stage, watch);
  }
  return {session.refined_scene(), session.rounds()};
}

}  // namespace transillum
