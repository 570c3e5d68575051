// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum study`: options, the series to study, and the study with progress and interruption.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "cli/arguments/checkpoint_options.h"
#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "cli/reports/summaries.h"
#include "io/drawing/study_chart.h"
#include "io/results/reference_cache.h"
#include "io/results/study_csv.h"
#include "io/runs/study_checkpoint.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/study.h"

namespace transillum::cli {
namespace {

struct StudiedEngine {
  Engine engine;
  int resolution;  ///< 0 means the value of --resolution, or, for engine pairs, of --points

  friend bool operator==(const StudiedEngine&, const StudiedEngine&) = default;
};

struct StudyCall {
  SceneInput scene;
  std::vector<int> directions{16, 64, 256, 1024};
  std::vector<Sampling> given_samplings;
  std::vector<Normalization> normalizations{Normalization::none};
  std::vector<Scheme> schemes{Scheme::fixed};
  std::vector<std::optional<double>> first_shots{std::nullopt};
  std::vector<StudiedEngine> engines{{Engine::fast, 0}};
  std::vector<Basis> bases{Basis::constant};
  bool one_way = false, two_way = false;
  StudyOptions study;
  StudyAxis against = StudyAxis::passes;
  ErrorMeasure error = ErrorMeasure::rms;  ///< in the table and the plots
  int reference = 0;                       ///< passes; 0: four times the largest number studied
  std::string cache = ReferenceCache::default_folder().string();
  std::string out;
  std::vector<std::string> plots;
  CheckpointCall checkpoint;
  bool quiet = false;

  StudyCall() { scene.run.solve = study.solve; }
  StudyOptions options() const {
    StudyOptions all = study;
    all.solve = scene.run.solve;
    return all;
  }
  bool uses(bool both_ways) const { return both_ways ? two_way || !one_way : one_way; }
  /// The given ones, or random, the paper's, and the default.
  std::vector<Sampling> samplings() const {
    return given_samplings.empty()
               ? std::vector{Sampling::random, Sampling::hammersley, default_sampling(uses(true))}
               : given_samplings;
  }
};

/// All combinations of the options, valid or not.
std::vector<StudySeries> all_combinations(const StudyCall& call) {
  std::vector<StudySeries> all;
  const EngineOptions& common = call.scene.run.solve.engine_options;
  const auto resolution_of = [&common](const StudiedEngine& studied) {
    if (studied.resolution > 0) {
      return studied.resolution;
    }
    return traits_of(studied.engine).takes_points ? common.points : common.resolution;
  };
  for (const Sampling sampling : call.samplings()) {
    for (const bool two_way : {false, true}) {
      if (!call.uses(two_way)) {
        continue;
      }
      for (const Normalization normalize : call.normalizations) {
        for (const Scheme scheme : call.schemes) {
          for (const std::optional<double>& first_shot : call.first_shots) {
            for (const StudiedEngine& studied : call.engines) {
              for (const Basis basis : call.bases) {
                all.push_back({sampling, two_way, normalize, scheme, first_shot, studied.engine,
                               resolution_of(studied), basis});
              }
            }
          }
        }
      }
    }
  }
  return all;
}

/// All valid combinations. Prints why others are skipped.
/// @throws InputError if none is valid
std::vector<StudySeries> all_series(const StudyCall& call) {
  std::vector<StudySeries> all;
  std::string refusal;
  for (StudySeries& series : all_combinations(call)) {
    if (!takes_directions(series.engine)) {
      // Sampling and two-way passes do not apply to it.
      series.sampling = call.samplings().front();
      series.two_way = call.uses(true);
      if (std::find(all.begin(), all.end(), series) != all.end()) {
        continue;
      }
    }
    try {
      StudyOptions alone = call.options();
      alone.series = {series};
      alone.directions.assign(1, call.directions.front());  // = {…}: GCC 14 warns of its array
      alone.validate();
      all.push_back(series);
    } catch (const InputError& error) {
      refusal = error.what();
    }
  }
  if (all.empty()) {
    throw InputError(refusal);
  }
  if (!refusal.empty()) {
    print_message("skipped: " + refusal);
  }
  return all;
}

/// Refuses options that do nothing for any of the series.
void check_options(const StudyCall& call, const StudyOptions& options) {
  const CLI::App& command = *call.scene.command;
  std::vector<RunOptions> solves;
  for (const StudySeries& series : options.series) {
    solves.push_back({.solve = options.solve_options(series, options.directions.front())});
  }
  const bool own_resolutions = std::all_of(call.engines.begin(), call.engines.end(),
                                           [](const auto& one) { return one.resolution > 0; });
  refuse_unless(!own_resolutions, command, "--resolution", "every engine has its own");
  const bool by_passes = std::any_of(solves.begin(), solves.end(), [](const RunOptions& run) {
    return takes_directions(run.solve.engine);
  });
  refuse_unused(call.scene, solves, by_passes && options.rotations > 1 ? "seed" : "");
  for (const std::string name : {"directions", "sampling", "one-way"}) {
    const std::string why = why_unused(name, solves);
    refuse_unless(why.empty(), command, "--" + name, why);
  }
  refuse_unless(by_passes, command, "--rotations", "not used with engine hemicube or pairs");
  refuse_unless(!call.plots.empty(), command, "--against", "used only with --plot");
}

StudyOptions study_options(const StudyCall& call) {
  StudyOptions options = call.options();
  options.directions = call.directions;
  options.series = all_series(call);
  options.validate();
  check_options(call, options);
  return options;
}

/// Data that all steps of a study share.
struct StudyContext {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  Cancellation cancellation;
  ProgressDisplay display;
};

/// The reference solution, from the cache or solved.
std::vector<Rgb> reference_radiosity(const StudyCall& call, const SolveOptions& options,
                                     StudyContext& context) {
  ReferenceSolution reference = find_or_solve_reference(
      ReferenceCache(call.cache), context.scene, context.tree, options,
      [&context](const SolveProgress& now) { context.display.show_passes("reference, ", now); },
      context.cancellation);
  if (!reference.store_error.empty()) {
    print_message("warning: the reference is not cached: " + reference.store_error);
  }
  return std::move(reference.radiosity);
}

void report_failures(const Study& study, const std::vector<std::string>& names) {
  for (const StudyPoint& point : study.points) {
    if (point.failure.empty()) {
      continue;
    }
    print_message(fmt::format("skipped: {} with {} passes: {}", names[point.series], point.passes,
                              point.failure + remedy_hint(point.remedy)));
  }
}

/// Writes the files and the table.
void write_outputs(const StudyCall& call, const StudyOptions& options, const Study& study,
                   const Scene& scene) {
  std::vector<std::function<void()>> writers;
  if (!call.out.empty()) {
    writers.emplace_back([&] {
      write_output(call.out,
                   [&](std::ostream& out) { write_study_csv(out, options.series, study); });
    });
  }
  for (const std::string& file : call.plots) {
    writers.emplace_back([&] {
      write_charts(file,
                   {study_chart(call.scene.spec, options.series, study, call.error, call.against)});
    });
  }
  const std::string summary = study_summary(scene, options, study, call.error);
  if (call.out.empty()) {
    writers.emplace_back([&] { print_results(summary); });
  } else if (!call.quiet) {
    writers.emplace_back([&] { print_diagnostics(summary); });
  }
  write_all(writers);
}

/// Keeps the points so far in the file of --checkpoint, if there is one.
class PointSaver {
 public:
  PointSaver(const CheckpointCall& call, const Scene& scene, const StudyOptions& options,
             const SolveOptions& reference) {
    if (call.file.empty()) {
      return;
    }
    checkpoint_.emplace(call.file, scene, options, reference);
    if (can_resume(call)) {
      done_ = points_ = checkpoint_->resume();
      print_message(fmt::format("{}: resumes after {} points", call.file, done_.size()));
    }
  }

  /// The points that need not be solved again.
  const std::vector<StudyPoint>& done() const { return done_; }
  /// Saves after each point, but at most once a second.
  void update(std::span<const StudyPoint> points) {
    if (points.size() <= points_.size()) {
      return;
    }
    points_.assign(points.begin(), points.end());
    if (Clock::now() - last_ >= std::chrono::seconds(1)) {
      save();
    }
  }
  /// An error is a warning: the study is worth more than its checkpoint.
  void save() {
    if (!checkpoint_) {
      return;
    }
    last_ = Clock::now();
    try {
      checkpoint_->save(points_);
    } catch (const std::runtime_error& error) {
      print_message(fmt::format("warning: the checkpoint could not be saved: {}", error.what()));
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<StudyCheckpoint> checkpoint_;
  std::vector<StudyPoint> done_, points_;
  Clock::time_point last_ = Clock::now();
};

int run(const StudyCall& call) {
  const StudyOptions options = study_options(call);
  for (const std::string& file : call.plots) {
    check_chart_path(file);
  }
  std::vector<std::string> files = call.plots;
  files.push_back(call.out);
  files.push_back(call.checkpoint.file);
  check_checkpoint(call.checkpoint);
  files = given_files(files);
  check_output_files(files);

  StudyContext context{{}, {}, cancel_on_signals(), ProgressDisplay(call.quiet)};
  context.scene = load_input_scene(call.scene, files, context.cancellation, Light::required);
  const SolveOptions reference_options = options.reference(call.reference);
  check_distinct(
      files, given_files(
                 {ReferenceCache(call.cache).file_of(*context.scene, reference_options).string()}));
  context.tree =
      build_tree(*context.scene, context.cancellation, context.display, reference_options.threads);
  const std::vector<Rgb> reference = reference_radiosity(call, reference_options, context);
  const std::vector<std::string> names = names_of(options.series);
  PointSaver saver(call.checkpoint, *context.scene, options, reference_options);
  const Study study = run_study(
      context.scene, context.tree, options, {reference, saver.done()},
      [&](const StudyProgress& now) {
        context.display.show(fmt::format("{}, {} passes", names[now.series], now.directions),
                             now.fraction, rate_text(now.passes_per_second, now.seconds_left));
        saver.update(now.points);
      },
      context.cancellation);
  context.display.clear();
  saver.save();
  if (study.points.empty()) {
    throw Canceled();  // nothing to save
  }

  report_failures(study, names);
  write_outputs(call, options, study, *context.scene);
  if (study.complete) {
    return success;
  }
  print_message(files.empty() ? "interrupted; these are the points so far"
                              : "interrupted; the points so far are saved");
  return interrupted;
}

/// An option with a list of distinct values, separated by commas.
template <typename Value, typename Parse>
void add_list_option(CLI::App& command, const std::string& name, const std::string& type,
                     const std::string& help, std::vector<Value>& values, Parse parse) {
  add_parsed_option(command, name, type, help, [=, &values](const std::string& text) {
    values.clear();
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      for (const Value& value : parse(text.substr(begin, end - begin))) {
        if (std::find(values.begin(), values.end(), value) != values.end()) {
          throw InputError(
              fmt::format("{}: \"{}\" is given twice", name, text.substr(begin, end - begin)));
        }
        values.push_back(value);
      }
      begin = end + 1;
    }
  });
}

/// `64`, or `16..1024` for 16, 32, 64 … 1024.
std::vector<int> parse_directions(const std::string& text) {
  const auto number = [](const std::string& digits) {
    return static_cast<int>(parse_whole_number("--directions", digits, 1, max_directions));
  };
  const std::size_t dots = text.find("..");
  if (dots == std::string::npos) {
    return {number(text)};
  }
  const int first = number(text.substr(0, dots)), last = number(text.substr(dots + 2));
  if (last < first) {
    throw InputError(fmt::format("--directions: \"{}\" is not an increasing range", text));
  }
  std::vector<int> powers;
  for (int m = first; m <= last; m *= 2) {
    powers.push_back(m);
  }
  return powers;
}

/// `fast`, `zbuffer:256` or `pairs:16`.
StudiedEngine parse_engine(const std::string& text) {
  const std::size_t colon = text.find(':');
  StudiedEngine engine{from_name<Engine>(text.substr(0, colon)), 0};
  if (colon != std::string::npos) {
    const auto parse = traits_of(engine.engine).takes_points ? parse_points : parse_resolution;
    engine.resolution = parse("--engines", text.substr(colon + 1));
  }
  return engine;
}

void add_series_options(CLI::App& command, StudyCall& call) {
  add_list_option(command, "-m,--directions", "M,M,...",
                  "numbers of passes; 16..1024 means 16,32,64,...,1024 (default "
                  "16,64,256,1024)",
                  call.directions, parse_directions);
  add_list_option(
      command, "--sampling", "NAME,...",
      fmt::format("{} (default random,hammersley,{}; --one-way alone: random,hammersley,{})",
                  fmt::join(names_of<Sampling>(), " | "), name_of(default_sampling(true)),
                  name_of(default_sampling(false))),
      call.given_samplings,
      [](const std::string& text) { return std::vector{from_name<Sampling>(text)}; });
  command.add_flag("--one-way", call.one_way, "use each pass for one direction, as in the paper");
  command.add_flag(
      "--two-way", call.two_way,
      "use each pass for a direction and its opposite (default); with --one-way: study "
      "both");
  add_list_option(command, "--normalize", "NAME,...",
                  fmt::format("{} (default none)", fmt::join(names_of<Normalization>(), " | ")),
                  call.normalizations, [](const std::string& text) {
                    return std::vector{from_name<Normalization>(text)};
                  });
  add_list_option(command, "--scheme", "NAME,...",
                  fmt::format("{} (default fixed)", fmt::join(names_of<Scheme>(), " | ")),
                  call.schemes,
                  [](const std::string& text) { return std::vector{from_name<Scheme>(text)}; });
  add_list_option(command, "--basis", "NAME,...",
                  fmt::format("{} (default constant); with linear, errors are L2 norms of "
                              "functions, against a linear reference",
                              fmt::join(names_of<Basis>(), " | ")),
                  call.bases,
                  [](const std::string& text) { return std::vector{from_name<Basis>(text)}; });
  add_list_option(command, "--first-shot", "RATIO,...",
                  "none | auto | a number: treat small bright sources separately, as in solve; the "
                  "reference does so if any series does (default none)",
                  call.first_shots, [](const std::string& text) {
                    return std::vector{parse_first_shot("--first-shot", text)};
                  });
  add_parsed_option(
      command, "--rotations", "R",
      "solve with R rotated sets per point; gives the RMS of their errors and the largest "
      "maximum (default 1: one set, not rotated)",
      [&call](const std::string& text) {
        call.study.rotations = static_cast<int>(parse_whole_number("--rotations", text, 1, 1000));
      });
  add_options(command, call.scene, {"seed"});
  add_list_option(
      command, "--engines,--engine", "NAME[:R],...",
      fmt::format(
          "{}; R: its resolution (of pairs: its points), instead of --resolution and --points "
          "(default {})",
          fmt::join(names_of<Engine>(), " | "), name_of(Engine::fast)),
      call.engines, [](const std::string& text) { return std::vector{parse_engine(text)}; });
  add_options(command, call.scene, {"resolution", "points", "order"});
}

void add_error_options(CLI::App& command, StudyCall& call) {
  command.add_flag_function(
      "--without-sources", [](std::int64_t) {},
      "no effect: errors are always errors of reflected light, without sources");
  add_parsed_option(
      command, "--error", "NAME",
      fmt::format("{}: error in the table and the plots (default rms); the CSV has both",
                  fmt::join(names_of<ErrorMeasure>(), " | ")),
      [&call](const std::string& text) { call.error = from_name<ErrorMeasure>(text); });
}

void add_reference_options(CLI::App& command, StudyCall& call) {
  add_parsed_option(command, "--reference", "M",
                    "passes of the reference solution, with fibonacci directions under a separate "
                    "rotation (default: four times the largest number studied)",
                    [&call](const std::string& text) {
                      call.reference = static_cast<int>(
                          parse_whole_number("--reference", text, 1, max_directions));
                    });
  auto* cache = command
                    .add_option("--cache", call.cache,
                                "folder that stores reference solutions (default: "
                                "$XDG_CACHE_HOME/transillum or ~/.cache/transillum); its files "
                                "may be deleted at any time")
                    ->type_name("FOLDER");
  command
      .add_flag_callback(
          "--no-cache", [&call] { call.cache.clear(); },
          "neither read nor store reference solutions")
      ->excludes(cache);
}

}  // namespace

Command add_study_command(CLI::App& program) {
  auto call = std::make_shared<StudyCall>();
  CLI::App& command =
      *program.add_subcommand("study", "Measures the error of B against the number of passes");
  add_scene_argument(command, call->scene);
  add_series_options(command, *call);
  add_error_options(command, *call);
  add_reference_options(command, *call);
  add_scene_options(command, call->scene);
  add_sections(command, call->scene, {"Machine"});
  command
      .add_option("-o,--out", call->out,
                  "CSV: sampling,directions,passes,rms_error,max_error,bound,seconds, engine,"
                  "resolution (default: a table on standard output)")
      ->type_name("FILE.csv");
  command
      .add_option(
          "--plot", call->plots,
          "plot of errors over passes, with slopes and the bound: .svg, .pdf or .png, by its "
          "ending; may be given several times")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  add_parsed_option(
      command, "--against", "AXIS",
      fmt::format("{}: horizontal axis of the plots (default passes); hemicubes and pairs "
                  "appear in plots over seconds only",
                  fmt::join(names_of<StudyAxis>(), " | ")),
      [call](const std::string& text) { call->against = from_name<StudyAxis>(text); });
  add_checkpoint_options(command, call->checkpoint,
                         "save the points so far in this file, so that --resume can continue");
  command.add_flag("-q,--quiet", call->quiet, "no progress and no table on standard error");
  for (const char* option :
       {"--normalize", "--scheme", "--basis", "--first-shot", "--rotations", "--two-way"}) {
    command.get_option(option)->group("Series");
  }
  for (const char* option : {"--without-sources", "--error", "--against", "--cache", "--no-cache",
                             "--checkpoint", "--resume"}) {
    command.get_option(option)->group("Reference and results");
  }
  command.footer(
      "rms_error: RMS over patches of the error of B, relative to the RMS of the reflected light,\n"
      "B - E; max_error: largest error over largest reflected light; both in the color channel\n"
      "that is off the most, without patches that emit; bound: eq. 37 with eq. 21; seconds:\n"
      "processor time of all threads.\n"
      "If series differ in more than the sampling, their names are extended, as in\n"
      "hammersley/one-way. Ctrl-C saves the points so far and exits with status 130.\n"
      "Example: transillum study cornell-box --directions 16..1024 --sampling random,fibonacci \\\n"
      "  --out study.csv --plot study.svg");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
