// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/commands/solve_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/reports/report_text.h"
#include "io/results/error_report_files.h"
#include "io/runs/shard_files.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/form_factor_solve.h"
#include "transillum/solve_session.h"

namespace transillum::cli {
namespace {

/// Where the display says an iteration is: in a round, with how many replicas.
std::string place_of(const SolveSession& session) {
  const std::string round =
      session.in_rounds() ? fmt::format("round {}, ", session.rounds().size() + 1) : std::string();
  const SolveOptions& options = session.options();
  return options.goal.is_set() ? fmt::format("{}{} replicas, ", round, options.replicas) : round;
}

void show_progress(ProgressDisplay& display, const SolveSession& session) {
  using Stage = SolveProgress::Stage;
  const SolveProgress progress = session.progress();
  const std::string iteration =
      fmt::format("{}iteration {}", place_of(session), progress.iteration + 1);
  if (progress.stage != Stage::passes) {
    display.show(
        progress.stage == Stage::scaling_lobes ? "scaling lobes" : iteration + ", reflecting",
        progress.stage_fraction,
        fmt::format("{:.3g} lobes/s, {} left", progress.lobes_per_second,
                    time_text(progress.seconds_left)));
  } else if (progress.direction > 0) {
    display.show_passes(iteration + ", ", progress);
  } else if (progress.iteration > 0) {
    display.show(fmt::format("iteration {}", progress.iteration), -1,
                 fmt::format("change {:.1e}", progress.change));
  }
}

/// Adds the result so far to a series: after an iteration, or within one the estimate by its
/// directions so far.
void add_to_series(const SolveJob& job, const SolveSession& session) {
  session.diffuse()->complete_estimate();
  if (job.series == nullptr) {
    return;
  }
  const SolveProgress progress = session.progress();
  const double fraction =
      progress.direction > 0 ? progress.direction / static_cast<double>(progress.passes) : 0.0;
  job.series->add(session.solution(), progress.iteration + fraction);
}

/// The checkpoint of a solve, if one is asked for. An error of saving is a warning: the solve is
/// worth more than its checkpoint.
class Saver {
 public:
  Saver(const SolveJob& job, std::optional<Checkpoint>& checkpoint)
      : job_(job), checkpoint_(checkpoint) {}

  /// Saves the state of a plan with each solve from now on.
  void set_plan(const TotalPlan& plan) {
    if (checkpoint_) {
      std::ostringstream state;
      plan.save(state);
      checkpoint_->set_total_plan(state.str());
    }
  }
  void save_if_due(const SolveSession& session) {
    constexpr double between_stages = 1;
    if (job_.sums) {
      save_together_if_due(session);
      return;
    }
    const bool stage_ends = session.options().goal.is_set() && session.progress().finished;
    attempt([&] {
      checkpoint_->save_if_due(session, stage_ends ? std::min(between_stages, job_.checkpoint_every)
                                                   : job_.checkpoint_every);
    });
  }
  /// Where the solve pauses or ends. The state of an accuracy is that before its last stage is
  /// judged.
  void save(const SolveSession& session) {
    const bool judged = session.options().goal.is_set() && session.progress().finished;
    if (!judged) {
      attempt([&] { checkpoint_->save(session); });
    }
  }

 private:
  /// The first process decides; asking it after each pass would take long.
  void save_together_if_due(const SolveSession& session) {
    constexpr int passes_between = 32;
    const int direction = session.progress().direction;
    if (!checkpoint_ || direction % (passes_between * job_.sums->size()) != 0) {
      return;
    }
    const bool due = checkpoint_->is_due(job_.checkpoint_every);
    if (job_.sums->from_first(due ? 1 : 0) > 0) {
      attempt([&] { checkpoint_->save(session); });
    }
  }
  template <class Save>
  void attempt(Save save) {
    if (!checkpoint_) {
      return;
    }
    try {
      save();
    } catch (const std::runtime_error& error) {
      job_.display.clear();
      print_message(fmt::format("warning: the checkpoint could not be saved: {}", error.what()));
    }
  }

  const SolveJob& job_;
  std::optional<Checkpoint>& checkpoint_;
};

/// The rounds of refinement, with a line for each.
void run_rounds(SolveSession& session, const SolveJob& job) {
  while (session.in_rounds()) {
    job.display.begin(fmt::format("round {}", session.rounds().size() + 1));
    session.advance(SolveSession::Until::stage, [&](const SolveSession& watched) {
      show_progress(job.display, watched);
      return true;
    });
    job.display.clear();
    const std::size_t number = session.rounds().size();
    if (number == 0 || job.quiet) {
      continue;
    }
    const RefinementRound& round = session.rounds().back();
    print_message(fmt::format("round {}: {} patches, {} {:.3g} % of B, {:.2g} s", number,
                              round.patches,
                              job.refine->by == RefineBy::jump ? "RMS jump" : "L2 error",
                              100 * round.measure, round.seconds));
  }
}

/// Makes the checkpoint that the job asks for.
/// @returns whether there is a run in its file to resume
bool make_checkpoint(const Scene& scene, const SolveJob& job,
                     std::optional<Checkpoint>& checkpoint) {
  if (job.checkpoint.file.empty()) {
    return false;
  }
  checkpoint.emplace(job.checkpoint.file, scene, job.options, job.total.has_value());
  return can_resume(job.checkpoint);
}

void resume(SolveSession& session, const SolveJob& job, Checkpoint& checkpoint,
            const std::string& stages = {}) {
  checkpoint.resume(session);
  const SolveProgress progress = session.progress();
  job.display.clear();
  print_message(
      fmt::format("{}: resumes after {}{} iterations{}, {:.3g} s done", job.checkpoint.file, stages,
                  progress.iteration,
                  progress.direction > 0
                      ? fmt::format(" and {} of {} passes", progress.direction, progress.passes)
                      : "",
                  session.seconds()));
}

void advance(SolveSession& session, const SolveJob& job, Saver& saver) {
  using Until = SolveSession::Until;
  bool unfinished = true;
  while (unfinished) {
    unfinished = session.advance(
        job.has_series ? Until::iteration : Until::finished, [&](const SolveSession& watched) {
          show_progress(job.display, watched);
          const SolveProgress now = watched.progress();
          const bool between = now.direction > 0 && now.direction < now.passes;
          // Here, not after a pause: other threads may finish more passes before it.
          if (job.series_every > 0 && between && now.direction % job.series_every == 0) {
            add_to_series(job, watched);
          }
          saver.save_if_due(watched);
          return true;
        });
    if (job.has_series) {
      add_to_series(job, session);
    }
  }
}

/// The passes of shards; null without any.
TransferEngine read_shards(const SolveJob& job) {
  if (job.shards.empty()) {
    return {};
  }
  job.display.begin("reading shards");
  return engine_of_shards(job.shards, *job.scene, job.options, job.cancellation);
}

SolveRequest request_of(const SolveJob& job) {
  return {.scene = job.scene,
          .options = job.options,
          .refine = job.refine,
          .engine = read_shards(job),
          .sums = job.sums,
          .preparing = [&job](Preparation preparation, double fraction) {
            job.display.show(preparation == Preparation::tree ? "building BSP tree" : "first shot",
                             fraction);
          }};
}

/// Engine pairs with as many points as an accuracy takes.
Solution solve_by_pairs_to(const AccuracyGoal& goal, const SolveJob& job) {
  check_form_factor_options(job.options);
  PairSolution pairs = solve_by_pairs(
      job.scene, job.options, goal.accuracy, job.cancellation, [&](int points, double fraction) {
        job.display.show(fmt::format("computing pairs, {} points", points), fraction);
      });
  AccuracyReport report;
  report.goal = goal;
  report.stages.push_back({pairs.points, 1, pairs.error});
  report.error = pairs.error;
  report.reached = pairs.reached;
  report.obstacle = pairs.reached ? AccuracyObstacle::none : AccuracyObstacle::directions;
  report.trusted = true;
  pairs.solution.accuracy = report;
  return std::move(pairs.solution);
}

MeasurementObserver measurement_display(const SolveJob& job) {
  return [&job](Measurement what, double fraction) {
    job.display.show(what == Measurement::replicas  ? "measuring errors: replicas"
                     : what == Measurement::engines ? "measuring errors: engines"
                                                    : "measuring errors: divided patches",
                     fraction);
  };
}

/// Solves a stage of a total error; saves it where it is interrupted.
void solve_stage(SolveSession& session, const SolveJob& job, Saver& saver) {
  try {
    advance(session, job, saver);
  } catch (const Canceled&) {
    if (session.is_prepared()) {
      saver.save(session);
    }
    throw;
  }
}

std::string stage_text(const std::vector<TotalStage>& stages) {
  const TotalStage& stage = stages.back();
  return fmt::format(
      "stage {}: {} patches, {} passes, {:.2g} s: {} of {} ({} directions, {} patches)",
      stages.size(), stage.patches, stage.passes, stage.seconds,
      error_percentage(stage.errors.total()), stage.surface,
      error_percentage(stage.errors.directions), error_percentage(stage.errors.patches));
}

/// Measures the errors of a finished solve. An interruption leaves them unknown.
void measure(const SolveSession& session, const SolveJob& job) {
  if (job.errors == nullptr || !session.finished()) {
    return;
  }
  job.display.begin("measuring errors");
  try {
    MeasuredSolve solve = measured_solve(session);
    ErrorReport report = measure_errors(solve, job.cancellation, measurement_display(job));
    job.errors->emplace(MeasuredErrors{std::move(solve), std::move(report), {}});
  } catch (const Canceled&) {
    job.display.clear();
    print_message("interrupted: the errors are not measured");
  }
}

/// Measures the cost of some passes, unless another engine made them. An interruption leaves it
/// unknown.
void measure_costs(const SolveJob& job, const SolveOptions& options,
                   std::shared_ptr<const Scene> scene, std::shared_ptr<const BspTree> tree,
                   const std::vector<Vec3>& directions) {
  if (job.costs == nullptr || options.engine != Engine::fast || directions.empty()) {
    return;
  }
  job.display.begin("measuring passes");
  try {
    *job.costs = patch_costs(options.engine, std::move(scene), std::move(tree),
                             directions_to_measure(directions), options.basis == Basis::linear,
                             job.cancellation);
  } catch (const Canceled&) {
    job.display.clear();
    print_message("interrupted: the cost of passes is not measured");
  }
}

/// Solves by passes.
Solution solve_by_passes(const SolveJob& job, std::optional<Checkpoint>& checkpoint) {
  SolveSession session(request_of(job), job.cancellation);
  run_rounds(session, job);
  if (make_checkpoint(*session.scene(), job, checkpoint)) {
    resume(session, job, *checkpoint);
  }
  session.prepare();
  const bool lobes = session.glossy() != nullptr;
  if (lobes) {
    job.display.begin("scaling lobes");
  } else {
    job.display.expect_passes("iteration 1, ", session.progress().passes);
  }
  Saver saver(job, checkpoint);
  try {
    advance(session, job, saver);
  } catch (const Canceled&) {
    if (lobes && session.progress().iteration == 0) {
      throw NothingToSave("no iteration was finished: nothing is saved");
    }
    if (!session.has_result()) {
      throw;
    }
  }
  if (session.is_prepared()) {
    saver.save(session);
  }
  measure(session, job);
  if (session.finished()) {
    measure_costs(job, session.options(), session.scene(), session.tree(), session.directions());
  }
  Solution solution = session.solution();
  if (job.form_factors && solution.complete && solution.statistics.kept_form_factors) {
    solution.form_factors = std::make_shared<const FormFactors>(session.diffuse()->form_factors());
  }
  return solution;
}

Solution solve_by_total(const SolveJob& job, std::optional<Checkpoint>& checkpoint) {
  TotalPlan plan(request_of(job), *job.total);
  bool resumes = make_checkpoint(*job.scene, job, checkpoint);
  if (resumes) {
    std::istringstream state(checkpoint->total_plan(job.cancellation));
    try {
      plan.restore(state, state.str().size(), job.cancellation);
    } catch (const std::runtime_error& error) {
      throw InputError(fmt::format("{}: {}", job.checkpoint.file, error.what()));
    }
  }
  Saver saver(job, checkpoint);
  const std::vector<TotalStage>& stages = plan.outcome().stages;
  try {
    while (!plan.finished()) {
      SolveSession session(plan.stage(), job.cancellation);
      if (resumes) {
        resume(session, job, *checkpoint, fmt::format("{} stages and ", stages.size()));
      }
      resumes = false;
      saver.set_plan(plan);
      solve_stage(session, job, saver);
      plan.assess(session, job.cancellation, measurement_display(job));
      job.display.clear();
      if (!job.quiet) {
        print_message(stage_text(stages));
      }
    }
  } catch (const Canceled&) {
    if (!plan.has_result()) {
      throw NothingToSave("no stage was measured: there is no result yet");
    }
    plan.cancel();
  }
  const TotalSolve& total = plan.outcome();
  const std::string text =
      fmt::format("{:.3g} % asked, {}; {} stages", 100 * job.total->total,
                  end_text(total.end, job.total->patches), total.stages.size());
  job.errors->emplace(MeasuredErrors{total.solve, total.report, text});
  if (total.solve.solution.complete) {
    measure_costs(job, total.solve.options, total.solve.solution.scene, total.solve.tree,
                  total.solve.directions);
  }
  return total.solve.solution;
}

/// Solves with the form factors in a file.
Solution solve_with_stored(const std::string& file, const SolveJob& job) {
  job.display.begin("reading form factors");
  StoredFormFactors stored = read_form_factors(file, job.cancellation);
  check_form_factors(*job.scene, stored);
  if (stored.polygons.empty()) {
    print_message(fmt::format(
        "warning: {}: the file does not say of which polygons its form factors are; {} the same, "
        "but an object that has moved is not noticed",
        file, stored.areas.empty() ? "the number of patches is" : "the areas are"));
  }
  job.display.begin("iterating");
  try {
    return solve_with_form_factors(job.scene, std::move(stored.form_factors), job.options,
                                   job.cancellation);
  } catch (const SolveError& error) {
    throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
  }
}

/// Solves with an engine that makes no passes.
Solution solve_without_directions(const SolveJob& job) {
  const SolveOptions& options = job.options;
  const bool hemicubes = traits_of(options.engine).factors == EngineTraits::Factors::hemicubes;
  if (options.goal.is_set() && !hemicubes) {
    return solve_by_pairs_to(options.goal, job);
  }
  const char* task = hemicubes ? "drawing hemicubes" : "computing pairs";
  const double patches = job.scene->patch_count();
  double done = 0;
  job.display.begin(task);
  try {
    return solve_by_form_factors(job.scene, options, job.cancellation, [&](double fraction) {
      done = fraction;
      job.display.show_rate(task, fraction, hemicubes ? patches : patches * (patches - 1) / 2,
                            hemicubes ? "hemicubes" : "pairs");
    });
  } catch (const Canceled&) {
    // Without all rows of F there is no useful estimate of B.
    throw NothingToSave(fmt::format(
        "{:.0f} % of the {}, but B requires all of them: nothing is saved", std::floor(100 * done),
        hemicubes ? "hemicubes were drawn" : "pairs were computed"));
  }
}

}  // namespace

std::optional<TotalGoal> total_goal(const RunOptions& run) {
  if (!run.total) {
    return std::nullopt;
  }
  TotalGoal goal;
  goal.total = run.solve.goal.accuracy;
  if (run.refine.patches > 0) {
    goal.patches = run.refine.patches;
  }
  return goal;
}

Solution run_job(const SolveJob& job, std::optional<Checkpoint>& checkpoint) {
  return !job.factors.empty()                   ? solve_with_stored(job.factors, job)
         : job.total                            ? solve_by_total(job, checkpoint)
         : takes_directions(job.options.engine) ? solve_by_passes(job, checkpoint)
                                                : solve_without_directions(job);
}

}  // namespace transillum::cli
