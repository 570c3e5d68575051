// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "interruption.h"
#include "messages.h"
#include "report_text.h"
#include "transillum/accuracy_plan.h"
#include "transillum/errors.h"
#include "transillum/form_factor_files.h"
#include "transillum/form_factor_solve.h"
#include "transillum/glossy.h"
#include "transillum/patch_count.h"
#include "transillum/shard_files.h"
#include "transillum/solve_errors.h"
#include "wall_clock.h"

namespace transillum::cli {
namespace {

void show_progress(ProgressDisplay& display, const RadiositySolver& solver) {
  const SolveProgress progress = solver.progress();
  const int replicas = solver.options().replicas;
  const std::string stage =
      solver.options().goal.set() ? fmt::format("{} replicas, ", replicas) : std::string();
  if (progress.direction > 0) {
    display.show_passes(fmt::format("{}iteration {}, ", stage, progress.iteration + 1), progress);
  } else if (progress.iteration > 0) {
    display.show(fmt::format("iteration {}", progress.iteration), -1,
                 fmt::format("change {:.1e}", progress.change));
  }
}

/// Of a solve in which lobes take part.
void show_lobes(ProgressDisplay& display, const SolveProgress& progress) {
  using Stage = SolveProgress::Stage;
  const std::string iteration = fmt::format("iteration {}", progress.iteration + 1);
  if (progress.stage != Stage::passes) {
    display.show(
        progress.stage == Stage::scaling_lobes ? "scaling lobes" : iteration + ", reflecting",
        progress.stage_share,
        fmt::format("{:.3g} lobes/s, {} left", progress.lobes_per_second,
                    time_text(progress.seconds_left)));
  } else if (progress.direction > 0) {
    display.show_passes(iteration + ", ", progress);
  } else {
    display.show(fmt::format("iteration {}", progress.iteration), -1,
                 fmt::format("change {:.1e}", progress.change));
  }
}

struct FirstShot {
  std::shared_ptr<const DirectLight> light;  ///< null if there is none
  double seconds = 0;
};

FirstShot shoot_first(const SolveJob& job) {
  const SolveOptions& options = job.options;
  FirstShot shot;
  if (!options.first_shot) {
    return shot;
  }
  const auto start = WallClock::now();
  shot.light = std::make_shared<const DirectLight>(
      shoot(*job.scene,
            first_shot_sources(*job.scene, *options.first_shot, expected_directions(options),
                               job.cancellation),
            options.threads, job.cancellation,
            [&](double share) { job.display.show("first shot", share); }));
  shot.seconds = seconds_since(start);
  return shot;
}

/// Adds the result so far to a series: after an iteration, or within one the estimate by its
/// directions so far.
void add_to_series(const SolveJob& job, const RadiositySolver& solver) {
  solver.complete_estimate();
  if (job.series == nullptr) {
    return;
  }
  const SolveProgress progress = solver.progress();
  const double share =
      progress.direction > 0 ? progress.direction / static_cast<double>(progress.passes) : 0.0;
  job.series->add(solver.solution(), progress.iteration + share);
}

/// The checkpoint of a solve, if one is asked for. An error of saving is a warning: the solve is
/// worth more than its checkpoint.
class Saver {
 public:
  explicit Saver(const SolveJob& job) : job_(job) {}

  /// Also after the last iteration of a stage, and where the solve is canceled.
  void save_if_due(const RadiositySolver& solver, const AccuracyPlan* plan) {
    constexpr double between_stages = 1;
    if (job_.group) {
      save_in_group_if_due(solver, plan);
      return;
    }
    attempt([&] {
      if (job_.cancellation.canceled()) {
        job_.checkpoint->save(solver, plan);
      } else {
        const bool stage_ends = plan != nullptr && solver.progress().finished;
        job_.checkpoint->save_if_due(
            solver, plan,
            stage_ends ? std::min(between_stages, job_.checkpoint_every) : job_.checkpoint_every);
      }
    });
  }
  void save(const RadiositySolver& solver) {
    attempt([&] { job_.checkpoint->save(solver); });
  }

 private:
  /// The first process decides; asking it after each pass would take long.
  void save_in_group_if_due(const RadiositySolver& solver, const AccuracyPlan* plan) {
    constexpr int passes_between = 32;
    const int direction = solver.progress().direction;
    if (job_.checkpoint == nullptr || direction % (passes_between * job_.group->size()) != 0) {
      return;
    }
    const bool due = job_.checkpoint->is_due(job_.checkpoint_every);
    if (job_.group->from_first(due ? 1 : 0) > 0) {
      attempt([&] { job_.checkpoint->save(solver, plan); });
    }
  }
  template <class Save>
  void attempt(Save save) {
    if (job_.checkpoint == nullptr) {
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
};

/// Advances a solver until it has finished.
void advance(RadiositySolver& solver, const SolveJob& job, Saver& saver) {
  const auto until =
      job.has_series ? RadiositySolver::Until::iteration : RadiositySolver::Until::finished;
  bool unfinished = true;
  while (unfinished) {
    unfinished = solver.advance(until, [&](const RadiositySolver& watched) {
      show_progress(job.display, watched);
      const SolveProgress now = watched.progress();
      const bool between = now.direction > 0 && now.direction < now.passes;
      // Here, not after a pause: other threads may finish more passes before it.
      if (job.series_every > 0 && between && now.direction % job.series_every == 0) {
        add_to_series(job, watched);
      }
      saver.save_if_due(watched, nullptr);
      return true;
    });
    if (job.has_series) {
      add_to_series(job, solver);
    }
  }
}

/// The solve of the checkpoint, and a message about where it goes on.
Checkpoint::Resumed resume(const SolveJob& job, const std::shared_ptr<const BspTree>& tree,
                           const std::shared_ptr<const DirectLight>& light) {
  Checkpoint::Resumed run =
      job.checkpoint->resume(job.scene, job.options, tree, light, job.cancellation, job.group);
  const SolveProgress progress = run.solver.progress();
  job.display.clear();
  print_message(
      fmt::format("{}: goes on after {} iterations{}, {:.3g} s done",
                  job.checkpoint->file().string(), progress.iteration,
                  progress.direction > 0
                      ? fmt::format(" and {} of {} passes", progress.direction, progress.passes)
                      : "",
                  run.seconds));
  return run;
}

/// What passes start from.
struct Prepared {
  std::shared_ptr<const BspTree> tree;
  FirstShot shot;
  double seconds_bsp = 0, seconds = 0;

  void add_times(SolveStatistics& statistics) const {
    statistics.seconds_bsp = seconds_bsp;
    statistics.seconds_first_shot = shot.seconds;
  }
};

Prepared prepare(const SolveJob& job) {
  const auto start = WallClock::now();
  Prepared prepared;
  const auto make = [&] {
    check_memory(job.scene->name(), job.scene->patch_count(), job.options.replicas,
                 job.options.basis == Basis::linear ? 3 : 1);
    prepared.tree = build_tree(*job.scene, job.cancellation, job.display, job.options.threads);
    prepared.seconds_bsp = seconds_since(start);
    prepared.shot = shoot_first(job);
  };
  if (job.group) {
    job.group->agree(make);
  } else {
    make();
  }
  prepared.seconds = seconds_since(start);
  return prepared;
}

/// Solves to the accuracy that is asked for.
Solution solve_to_goal(const SolveJob& job) {
  const Prepared prepared = prepare(job);
  Saver saver(job);
  double seconds = prepared.seconds;
  std::optional<AccuracyRun> run;
  if (job.resume) {
    Checkpoint::Resumed resumed = resume(job, prepared.tree, prepared.shot.light);
    run.emplace(AccuracyRun{std::move(*resumed.plan), std::move(resumed.solver)});
    seconds += resumed.seconds;
  }
  Solution solution = solve_to_accuracy(
      job.scene, job.options, prepared.tree, prepared.shot.light,
      [&](const RadiositySolver& watched, const AccuracyPlan& plan) {
        show_progress(job.display, watched);
        saver.save_if_due(watched, &plan);
        return true;
      },
      job.cancellation, seconds, std::move(run), job.group);
  prepared.add_times(solution.statistics);
  return solution;
}

/// The passes of shards; null without any.
TransferEngine read_shards(const SolveJob& job) {
  if (job.shards.empty()) {
    return {};
  }
  job.display.begin("reading shards");
  return engine_of_shards(job.shards, *job.scene, job.options, job.cancellation);
}

/// The solver to be advanced: of the checkpoint, or a new one.
RadiositySolver make_solver(const SolveJob& job, const Prepared& prepared, TransferEngine engine) {
  if (job.resume) {
    return resume(job, prepared.tree, prepared.shot.light).solver;
  }
  return {job.scene,           job.options,       prepared.tree, job.cancellation,
          prepared.shot.light, std::move(engine), job.group};
}

/// Engine pairs with as many points as an accuracy takes.
Solution solve_by_pairs_to(const AccuracyGoal& goal, const SolveJob& job) {
  check_form_factor_options(job.options);
  PairSolution pairs = solve_by_pairs(
      job.scene, job.options, goal.accuracy, job.cancellation, [&](int points, double share) {
        job.display.show(fmt::format("computing pairs, {} points", points), share);
      });
  AccuracyReport report;
  report.goal = goal;
  report.stages.push_back({pairs.points, 1, pairs.error});
  report.error = pairs.error;
  report.reached = pairs.reached;
  report.trusted = true;
  pairs.solution.accuracy = report;
  return std::move(pairs.solution);
}

}  // namespace

Solution solve_by_passes(const SolveJob& job) {
  if (job.options.goal.set()) {
    return solve_to_goal(job);
  }
  TransferEngine shards = read_shards(job);
  const Prepared prepared = prepare(job);
  RadiositySolver solver = make_solver(job, prepared, std::move(shards));
  Saver saver(job);
  job.display.expect_passes("iteration 1, ", solver.progress().passes);
  try {
    advance(solver, job, saver);
  } catch (const Canceled&) {
    const SolveProgress progress = solver.progress();
    if (progress.direction == 0 && progress.iteration == 0) {
      throw;  // nothing to save
    }
  }
  saver.save(solver);
  Solution solution = solver.solution();
  if (job.form_factors && solution.complete && solution.statistics.kept_form_factors) {
    solution.form_factors = std::make_shared<const FormFactors>(solver.form_factors());
  }
  prepared.add_times(solution.statistics);
  return solution;
}

Solution solve_with_lobes(const SolveJob& job) {
  const Prepared prepared = prepare(job);
  GlossySolver solver(job.scene, job.options, prepared.tree, job.cancellation);
  job.display.begin("scaling lobes");
  try {
    solver.solve([&](const SolveProgress& progress) {
      show_lobes(job.display, progress);
      return true;
    });
  } catch (const Canceled&) {
    if (solver.progress().iteration == 0) {
      throw NothingToSave("no iteration was finished: nothing is saved");
    }
  }
  Solution solution = solver.solution();
  prepared.add_times(solution.statistics);
  return solution;
}

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

Solution solve_without_directions(const SolveJob& job) {
  const SolveOptions& options = job.options;
  if (options.goal.set() && options.engine == Engine::pairs) {
    return solve_by_pairs_to(options.goal, job);
  }
  const bool hemicubes = options.engine == Engine::hemicube;
  const char* task = hemicubes ? "drawing hemicubes" : "computing pairs";
  const double patches = job.scene->patch_count();
  double done = 0;
  job.display.begin(task);
  try {
    return solve_by_form_factors(job.scene, options, job.cancellation, [&](double share) {
      done = share;
      job.display.show_rate(task, share, hemicubes ? patches : patches * (patches - 1) / 2,
                            hemicubes ? "hemicubes" : "pairs");
    });
  } catch (const Canceled&) {
    // Without all rows of F there is no useful estimate of B.
    throw NothingToSave(fmt::format(
        "{:.0f} % of the {}, but B requires all of them: nothing is saved", std::floor(100 * done),
        hemicubes ? "hemicubes were drawn" : "pairs were computed"));
  }
}

}  // namespace transillum::cli
