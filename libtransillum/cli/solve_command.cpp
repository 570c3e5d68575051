// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum solve`: options, the solve with progress and interruption, and its output files.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>

#include "color_outputs.h"
#include "commands.h"
#include "interruption.h"
#include "messages.h"
#include "option_values.h"
#include "output_files.h"
#include "power_report.h"
#include "progress_display.h"
#include "scene_options.h"
#include "sequence_options.h"
#include "solve_summary.h"
#include "standard_output.h"
#include "transillum/accuracy_plan.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/form_factor_files.h"
#include "transillum/form_factor_solve.h"
#include "transillum/solve_errors.h"
#include "transillum/study.h"

namespace transillum::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct SolveCall {
  const CLI::App* command = nullptr;
  SceneInput scene;
  SequenceOptions sequence;
  SolveOptions options;
  bool one_way = false, two_way = false;
  bool stop_given = false;  ///< --iterations or --tolerance
  bool shot_given = false;  ///< --first-shot
  std::vector<std::string> out;
  std::string stats;
  std::optional<PartsBy> by;  ///< --by
  std::string factors;        ///< --factors
  ColorOutputs colors;
  bool quiet = false;
};

/// What all ways of solving need.
struct SolveJob {
  std::shared_ptr<const Scene> scene;
  SolveOptions options;
  const Cancellation& cancellation;
  ProgressDisplay& display;
  bool form_factors = false;       ///< wanted in the solution, if they are kept
  ResultSeries* series = nullptr;  ///< gets the result after every iteration
  int series_every = 0;            ///< and after so many directions; 0: not
};

std::vector<std::string> checked_outputs(const SolveCall& call) {
  if (std::count_if(call.out.begin(), call.out.end(), is_standard_output) > 1) {
    throw InputError("--out: standard output (-) is given twice");
  }
  std::vector<std::string> files = given_files(call.out);
  for (const std::string& file : files) {
    check_result_path(file);
  }
  if (!call.stats.empty()) {
    if (is_standard_output(call.stats)) {
      throw InputError("--stats: standard output (-) takes only the CSV of --out; name a file");
    }
    check_statistics_path(call.stats);
    files.push_back(call.stats);
  }
  if (!call.colors.series.empty()) {
    files.push_back(call.colors.series);
  }
  check_output_files(files);
  if (!call.factors.empty()) {
    check_distinct(files, {call.factors});
  }
  return files;
}

/// Refuses options that say how form factors are computed.
void check_stored_factors(const SolveCall& call) {
  if (call.factors.empty()) {
    return;
  }
  for (const char* option :
       {"--directions", "--sampling", "--seed",      "--rotate",  "--engine",
        "--resolution", "--points",   "--lines",     "--order",   "--random-lines",
        "--one-way",    "--two-way",  "--normalize", "--scheme",  "--first-shot",
        "--burn-in",    "--replicas", "--accuracy",  "--seconds", "--sky",
        "--memory"}) {
    refuse_unless(false, *call.command, option, "not used with --factors");
  }
}

SolveOptions solve_options(const SolveCall& call) {
  check_stored_factors(call);
  SolveOptions options = call.options;
  options.directions = call.sequence.directions;
  options.sampling = call.sequence.sampling;
  options.seed = options.engine_options.seed = call.sequence.seed;
  options.rotation = call.sequence.rotation;
  options.two_way = !call.one_way;
  // Its error decreases as 1 / sqrt(iterations): the default tolerance would take days.
  if (options.scheme == Scheme::semi_iterative && !call.stop_given) {
    options.averaged_iterations = default_averaged_iterations;
  }
  if (options.goal.set() && !call.shot_given && takes_directions(options.engine)) {
    options.first_shot = first_shot_where_it_pays;
  }
  options.validate();
  refuse_unused(*call.command, {options});
  check_color_outputs(*call.command, call.colors, call.out, options);
  return options;
}

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
  const auto start = Clock::now();
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
void add_to_series(ResultSeries& series, const RadiositySolver& solver) {
  const SolveProgress progress = solver.progress();
  const double share =
      progress.direction > 0 ? progress.direction / static_cast<double>(progress.passes) : 0.0;
  series.add(solver.solution(), progress.iteration + share);
}

/// Advances a solver until it has finished.
void advance(RadiositySolver& solver, const SolveJob& job) {
  const auto until =
      job.series != nullptr ? RadiositySolver::Until::iteration : RadiositySolver::Until::finished;
  bool unfinished = true;
  while (unfinished) {
    unfinished = solver.advance(until, [&](const RadiositySolver& watched) {
      show_progress(job.display, watched);
      const SolveProgress now = watched.progress();
      const bool between = now.direction > 0 && now.direction < now.passes;
      // Here, not after a pause: other threads may finish more passes before it.
      if (job.series_every > 0 && between && now.direction % job.series_every == 0) {
        add_to_series(*job.series, watched);
      }
      return true;
    });
    if (job.series != nullptr) {
      add_to_series(*job.series, solver);
    }
  }
}

/// Runs the solver until it has finished or is interrupted.
Solution solve_by_passes(const SolveJob& job) {
  const std::shared_ptr<const Scene>& scene = job.scene;
  const SolveOptions& options = job.options;
  ProgressDisplay& display = job.display;
  const auto start = Clock::now();
  const auto tree = build_tree(*scene, job.cancellation, display, options.threads);
  const double seconds_bsp = seconds_since(start);
  const auto shot = shoot_first(job);
  if (options.goal.set()) {
    Solution solution = solve_to_accuracy(
        scene, options, tree, shot.light,
        [&](const RadiositySolver& watched) {
          show_progress(display, watched);
          return true;
        },
        job.cancellation, seconds_since(start));
    solution.statistics.seconds_bsp = seconds_bsp;
    solution.statistics.seconds_first_shot = shot.seconds;
    return solution;
  }
  RadiositySolver solver(scene, options, tree, job.cancellation, shot.light);
  display.expect_passes("iteration 1, ", solver.progress().passes);
  try {
    advance(solver, job);
  } catch (const Canceled&) {
    const SolveProgress progress = solver.progress();
    if (progress.direction == 0 && progress.iteration == 0) {
      throw;  // nothing to save
    }
  }
  Solution solution = solver.solution();
  if (job.form_factors && solution.complete && solution.statistics.kept_form_factors) {
    solution.form_factors = std::make_shared<const FormFactors>(solver.form_factors());
  }
  solution.statistics.seconds_bsp = seconds_bsp;
  solution.statistics.seconds_first_shot = shot.seconds;
  return solution;
}

/// Solves with the form factors of --factors.
Solution solve_with_stored(const std::string& file, const SolveJob& job) {
  job.display.begin("reading form factors");
  StoredFormFactors stored = read_form_factors(file, job.cancellation);
  check_form_factors(*job.scene, stored);
  job.display.begin("iterating");
  try {
    return solve_with_form_factors(job.scene, std::move(stored.form_factors), job.options,
                                   job.cancellation);
  } catch (const SolveError& error) {
    throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
  }
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

/// The table of --by, on standard output unless a result is there.
void print_powers(const SolveCall& call, const Solution& solution) {
  const std::string text =
      power_report(power_table(solution, *call.by, solution.form_factors.get()), *call.by) + "\n";
  if (std::any_of(call.out.begin(), call.out.end(), is_standard_output)) {
    print_diagnostics(text);
  } else {
    print_results(text);
  }
}

/// Writes the files and the summary.
void write_outputs(const SolveCall& call, const SolveOptions& options, const Solution& solution) {
  std::vector<std::function<void()>> writers;
  for (const std::string& file : call.out) {
    writers.emplace_back([&] {
      if (is_standard_output(file)) {
        print_results([&](std::ostream& out) { write_result_csv(out, solution); });
      } else {
        write_result(file, solution, call.colors.display);
      }
    });
  }
  if (!call.stats.empty()) {
    writers.emplace_back([&] { write_statistics(call.stats, options, solution); });
  }
  if (call.by) {
    writers.emplace_back([&] { print_powers(call, solution); });
  }
  if (call.out.empty()) {
    writers.emplace_back([&] { print_results(solve_summary(solution)); });
  } else if (!call.quiet) {
    writers.emplace_back([&] { print_diagnostics(solve_summary(solution)); });
  }
  write_all(writers);
}

int run(const SolveCall& call) {
  const auto start = Clock::now();
  const std::vector<std::string> outputs = checked_outputs(call);
  const SolveOptions options = solve_options(call);
  const Cancellation& cancellation = cancel_on_signals();
  ProgressDisplay display(call.quiet);
  const auto scene = load_input_scene(call.scene, outputs, cancellation,
                                      options.sky.set() ? Light::optional : Light::required);
  const double seconds_load = seconds_since(start);

  std::optional<ResultSeries> series;
  if (!call.colors.series.empty()) {
    series.emplace(call.colors.series);
  }
  const SolveJob job{scene,
                     options,
                     cancellation,
                     display,
                     call.by.has_value(),
                     series ? &*series : nullptr,
                     call.colors.series_every};
  Solution solution = !call.factors.empty()              ? solve_with_stored(call.factors, job)
                      : takes_directions(options.engine) ? solve_by_passes(job)
                                                         : solve_without_directions(job);
  display.clear();
  solution.statistics.seconds_load = seconds_load;
  solution.statistics.seconds_total = seconds_since(start);
  for (const std::string& warning : solve_warnings(solution)) {
    print_message("warning: " + warning);
  }
  write_outputs(call, options, solution);
  if (solution.complete) {
    return success;
  }
  print_message(call.out.empty() && call.stats.empty()
                    ? "interrupted; the summary is of the estimate so far"
                    : "interrupted; the results so far are saved");
  return interrupted;
}

void add_stopping_rules(CLI::App& command, SolveCall& call) {
  auto* iterations = add_parsed_option(
      command, "--iterations", "K", description_of("iterations"), [&call](const std::string& text) {
        call.options.iterations =
            static_cast<int>(parse_whole_number("--iterations", text, 1, 1'000'000));
        call.stop_given = true;
      });
  auto* tolerance =
      add_parsed_option(command, "--tolerance", "T", help_of("tolerance", call.options.tolerance),
                        [&call](const std::string& text) {
                          call.options.tolerance = parse_number("--tolerance", text);
                          call.stop_given = true;
                          if (!(call.options.tolerance > 0 && call.options.tolerance < 1)) {
                            throw InputError(fmt::format(
                                "--tolerance: \"{}\" is not greater than 0 and less than 1", text));
                          }
                        });
  iterations->excludes(tolerance);
}

void add_estimator(CLI::App& command, SolveCall& call) {
  SolveOptions& options = call.options;
  add_engine_options(command, options.engine, options.engine_options);
  auto* one_way = command.add_flag("--one-way", call.one_way,
                                   "use each pass for one direction, as in the paper");
  auto* two_way = command.add_flag("--two-way", call.two_way, help_of("two-way", "yes"));
  one_way->excludes(two_way);
  add_parsed_option(
      command, "--normalize", "NAME", help_of("normalize", name_of(options.normalize)),
      [&options](const std::string& text) { options.normalize = normalization_from_name(text); });
}

void add_scheme(CLI::App& command, SolveCall& call) {
  SolveOptions& options = call.options;
  add_parsed_option(
      command, "--scheme", "NAME", help_of("scheme", name_of(options.scheme)),
      [&options](const std::string& text) { options.scheme = scheme_from_name(text); });
  add_parsed_option(command, "--first-shot", "RATIO",
                    choice_help("first-shot", {"none", "auto", "a number"}, "none"),
                    [&call, &options](const std::string& text) {
                      options.first_shot = parse_first_shot("--first-shot", text);
                      call.shot_given = true;
                    });
  add_parsed_option(
      command, "--burn-in", "N", help_of("burn-in", "auto"), [&options](const std::string& text) {
        options.burn_in.reset();
        if (text != "auto") {
          options.burn_in = static_cast<int>(parse_whole_number("--burn-in", text, 0, 1'000'000));
        }
      });
  add_parsed_option(command, "--replicas", "R", help_of("replicas", "1: no error estimate"),
                    [&options](const std::string& text) {
                      options.replicas =
                          static_cast<int>(parse_whole_number("--replicas", text, 1, 64));
                    });
}

void add_goal(CLI::App& command, AccuracyGoal& goal) {
  add_parsed_option(
      command, "--accuracy", "P%|X", description_of("accuracy"),
      [&goal](const std::string& text) { goal.accuracy = parse_accuracy("--accuracy", text); });
  add_parsed_option(command, "--accuracy-of", "NAME",
                    choice_help("accuracy-of", {"rms", "max", "patch:I", "mean"}, "rms"),
                    [&goal](const std::string& text) {
                      const AccuracyGoal of = parse_accuracy_of("--accuracy-of", text);
                      goal.of = of.of;
                      goal.patch = of.patch;
                    });
  add_parsed_option(
      command, "--seconds", "S", description_of("seconds"), [&goal](const std::string& text) {
        goal.seconds = parse_number("--seconds", text);
        if (!(goal.seconds > 0)) {
          throw InputError(fmt::format("--seconds: \"{}\" is not greater than 0", text));
        }
      });
}

void add_outputs(CLI::App& command, SolveCall& call) {
  command
      .add_option(
          "-o,--out", call.out,
          "result file: .csv, .vtp, .ply, .obj, .glb or .gltf, by its ending, or - for CSV on "
          "standard output; "
          "may be given several times "
          "(default: a summary on standard output)")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      .add_option("--stats", call.stats,
                  "statistics: counts, times, change per iteration, closure and energy defects")
      ->type_name("FILE.json");
  add_color_outputs(command, call.colors);
  add_parsed_option(command, "--by", "NAME",
                    fmt::format("print area and power emitted, received, absorbed, escaped and "
                                "exchanged, by {}",
                                fmt::join(parts_by_names(), " or ")),
                    [&call](const std::string& text) { call.by = parts_by_from_name(text); });
  command.add_flag("-q,--quiet", call.quiet, "no progress and no summary on standard error");
}

}  // namespace

Run add_solve_command(CLI::App& program) {
  auto call = std::make_shared<SolveCall>();
  CLI::App& command = *program.add_subcommand("solve", "Computes the radiosity of every patch");
  call->command = &command;
  add_scene_argument(command, call->scene);
  add_sequence_options(command, call->sequence);
  add_estimator(command, *call);
  add_scheme(command, *call);
  add_goal(command, call->options.goal);
  add_stopping_rules(command, *call);
  add_scene_options(command, call->scene);
  add_sky_options(command, call->options.sky);
  command
      .add_option("--factors", call->factors,
                  "iterate with the form factors in this file, .npz or .mtx, instead of computing "
                  "them; it is checked against the scene")
      ->type_name("FILE");
  add_machine_limits(command, call->options.memory, call->options.threads);
  add_outputs(command, *call);
  command.footer(
      "Columns: face,patch,area,E_r,E_g,E_b,rho_r,rho_g,rho_b,B_r,B_g,B_b,H_r,H_g,H_b,F_sum,sky,\n"
      "group,material; areas in m2, exitance E, radiosity B and irradiance H in W/m2.\n"
      "Ctrl-C saves the results so far and exits with status 130; pressed twice, it exits "
      "immediately.\n"
      "Example: transillum solve cornell-box --max-patch-area 0.01 -m 256 --out cornell.vtp");
  return [call] {
    set_up_of_display(*call->command, call->options.sky, call->colors);
    return run(*call);
  };
}

}  // namespace transillum::cli
