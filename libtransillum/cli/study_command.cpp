// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands.h"
#include "interruption.h"
#include "messages.h"
#include "option_values.h"
#include "output_files.h"
#include "progress_display.h"
#include "study_summary.h"
#include "transillum/errors.h"
#include "transillum/reference_cache.h"
#include "transillum/study.h"
#include "transillum/study_files.h"

namespace transillum::cli {
namespace {

struct StudiedEngine {
  Engine engine;
  int resolution;  ///< 0: that of --resolution

  friend bool operator==(const StudiedEngine&, const StudiedEngine&) = default;
};

struct StudyCall {
  std::string scene;
  SceneOptions scene_options;
  std::vector<int> directions{16, 64, 256, 1024};
  std::vector<Sampling> samplings{Sampling::random, Sampling::hammersley, Sampling::fibonacci};
  std::vector<Normalization> normalizations{Normalization::none};
  std::vector<Scheme> schemes{Scheme::fixed};
  std::vector<std::optional<double>> first_shots{std::nullopt};
  std::vector<StudiedEngine> engines{{Engine::fast, 0}};
  bool one_way = false, two_way = false;
  StudyOptions study;
  StudyAxis against = StudyAxis::passes;
  ErrorMeasure error = ErrorMeasure::rms;  ///< that table and plots tell
  int reference = 0;                       ///< passes; 0: four times the most that are studied
  std::string cache = ReferenceCache::default_folder().string();
  std::string out;
  std::vector<std::string> plots;
  bool quiet = false;
};

/// All combinations, whether they go together or not.
std::vector<StudySeries> all_combinations(const StudyCall& call) {
  std::vector<StudySeries> all;
  const int resolution = call.study.solve.engine_options.resolution;
  for (const Sampling sampling : call.samplings) {
    for (const bool two_way : {false, true}) {
      if (!(two_way ? call.two_way || !call.one_way : call.one_way)) {
        continue;
      }
      for (const Normalization normalize : call.normalizations) {
        for (const Scheme scheme : call.schemes) {
          for (const std::optional<double>& first_shot : call.first_shots) {
            for (const StudiedEngine& of : call.engines) {
              all.push_back({sampling, two_way, normalize, scheme, first_shot, of.engine,
                             of.resolution > 0 ? of.resolution : resolution});
            }
          }
        }
      }
    }
  }
  return all;
}

/// All combinations that go together; what does not is named, unless nothing is left.
std::vector<StudySeries> all_series(const StudyCall& call) {
  std::vector<StudySeries> all;
  std::string refusal;
  for (StudySeries& series : all_combinations(call)) {
    if (!takes_directions(series.engine)) {
      // Whatever directions others take, it is the same.
      series.sampling = call.samplings.front();
      series.two_way = call.two_way || !call.one_way;
      if (std::find(all.begin(), all.end(), series) != all.end()) {
        continue;
      }
    }
    try {
      StudyOptions alone = call.study;
      alone.series = {series};
      alone.directions = {call.directions.front()};
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
    print_message("left out: " + refusal);
  }
  return all;
}

StudyOptions study_options(const StudyCall& call) {
  StudyOptions options = call.study;
  options.directions = call.directions;
  options.series = all_series(call);
  options.validate();
  return options;
}

/// What all steps of a study share.
struct StudyContext {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const BspTree> tree;
  Cancellation cancellation;
  ProgressDisplay display;
  bool quiet = false;

  void show(const std::string& what, double share, double rate, double seconds_left) {
    if (quiet) {
      return;
    }
    display.show(what, share,
                 fmt::format("{:.1f} passes/s, {} left", rate, time_text(seconds_left)));
  }
};

/// The reference solution, from the cache or solved.
std::vector<Rgb> reference_radiosity(const StudyCall& call, const SolveOptions& options,
                                     StudyContext& context) {
  ReferenceSolution reference = find_or_solve_reference(
      ReferenceCache(call.cache), context.scene, context.tree, options,
      [&context](const SolveProgress& now) {
        if (now.direction > 0) {
          context.show(fmt::format("reference, pass {}/{}", now.direction, now.passes),
                       static_cast<double>(now.direction) / now.passes, now.passes_per_second,
                       now.seconds_left);
        }
      },
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
    print_message(fmt::format("left out: {} with {} passes: {}", names[point.series], point.passes,
                              point.failure + remedy_hint(point.remedy)));
  }
}

int run(const StudyCall& call) {
  const StudyOptions options = study_options(call);
  for (const std::string& file : call.plots) {
    check_chart_path(file);
  }
  std::vector<std::string> files = call.plots;
  if (!call.out.empty()) {
    files.push_back(call.out);
  }
  check_output_files(files, call.scene);

  StudyContext work;
  work.cancellation = cancel_on_signals();
  work.quiet = call.quiet;
  work.scene = load_scene(call.scene, call.scene_options, work.cancellation);
  print_warnings(*work.scene);
  work.tree = std::make_shared<const BspTree>(*work.scene, work.cancellation, [&](double share) {
    if (!call.quiet) {
      work.display.show("sorting", share);
    }
  });
  const std::vector<Rgb> reference =
      reference_radiosity(call, options.reference(call.reference), work);
  const std::vector<std::string> names = names_of(options.series);
  const Study study = run_study(
      work.scene, work.tree, options, reference,
      [&](const StudyProgress& now) {
        work.show(fmt::format("{}, {} passes", names[now.series], now.directions), now.share,
                  now.passes_per_second, now.seconds_left);
      },
      work.cancellation);
  work.display.clear();
  if (study.points.empty()) {
    throw Canceled();  // there is nothing to save
  }

  report_failures(study, names);
  if (!call.out.empty()) {
    write_study_csv(call.out, options.series, study);
  }
  for (const std::string& file : call.plots) {
    write_charts(file, {study_chart(call.scene, options.series, study, call.error, call.against)});
  }
  const std::string summary = study_summary(*work.scene, options, study, call.error);
  if (call.out.empty()) {
    fmt::print("{}", summary);
  } else if (!call.quiet) {
    fmt::print(stderr, "{}", summary);
  }
  if (study.complete) {
    return success;
  }
  print_message(files.empty() ? "interrupted; these are the points so far"
                              : "interrupted; the points so far are saved");
  return interrupted;
}

/// An option that takes values with commas between, each once.
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
              fmt::format("{}: \"{}\" is there twice", name, text.substr(begin, end - begin)));
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
    throw InputError(fmt::format("--directions: \"{}\" ends before it begins", text));
  }
  std::vector<int> doubled;
  for (int m = first; m <= last; m *= 2) {
    doubled.push_back(m);
  }
  return doubled;
}

/// `fast`, or `zbuffer:256`.
StudiedEngine parse_engine(const std::string& text) {
  const std::size_t colon = text.find(':');
  StudiedEngine engine{engine_from_name(text.substr(0, colon)), 0};
  if (colon != std::string::npos) {
    engine.resolution = parse_resolution("--engines", text.substr(colon + 1));
  }
  return engine;
}

void add_series_options(CLI::App& command, StudyCall& call) {
  add_list_option(command, "-m,--directions", "M,M,...",
                  "passes of each solve; 16..1024 stands for 16,32,64,...,1024 (default "
                  "16,64,256,1024)",
                  call.directions, parse_directions);
  add_list_option(
      command, "--sampling", "NAME,...",
      fmt::format("{} (default random,hammersley,fibonacci)", fmt::join(sampling_names(), " | ")),
      call.samplings,
      [](const std::string& text) { return std::vector{sampling_from_name(text)}; });
  command.add_flag("--one-way", call.one_way, "use each direction alone, as the paper does");
  command.add_flag("--two-way", call.two_way,
                   "use each direction and its opposite in one pass (default); with --one-way: "
                   "study both");
  add_list_option(command, "--normalize", "NAME,...",
                  fmt::format("{} (default none)", fmt::join(normalization_names(), " | ")),
                  call.normalizations, [](const std::string& text) {
                    return std::vector{normalization_from_name(text)};
                  });
  add_list_option(command, "--scheme", "NAME,...",
                  fmt::format("{} (default fixed)", fmt::join(scheme_names(), " | ")), call.schemes,
                  [](const std::string& text) { return std::vector{scheme_from_name(text)}; });
  add_list_option(command, "--first-shot", "RATIO,...",
                  "none | auto | a number: small bright sources shot first, as solve does; the "
                  "reference shoots where any series does (default none)",
                  call.first_shots,
                  [](const std::string& text) { return std::vector{first_shot_from_name(text)}; });
  add_parsed_option(command, "--rotations", "R",
                    "solve each with R rotated sets: the RMS of their errors, the largest maximum "
                    "(default 1: the set as it is)",
                    [&call](const std::string& text) {
                      call.study.rotations =
                          static_cast<int>(parse_whole_number("--rotations", text, 1, 1000));
                    });
  add_parsed_option(
      command, "--seed", "S",
      fmt::format("for samplings that are seeded, and rotations (default {})",
                  call.study.solve.seed),
      [&call](const std::string& text) { call.study.solve.seed = parse_seed("--seed", text); });
  add_list_option(command, "--engines,--engine", "NAME[:R],...",
                  fmt::format("{}; with R: of that --resolution (default {})",
                              fmt::join(engine_names(), " | "), name_of(Engine::fast)),
                  call.engines,
                  [](const std::string& text) { return std::vector{parse_engine(text)}; });
  add_engine_details(command, call.study.solve.engine_options);
}

void add_error_options(CLI::App& command, StudyCall& call) {
  command.add_flag("--without-sources", call.study.without_sources,
                   "leave patches that emit out of the errors");
  add_parsed_option(
      command, "--error", "NAME",
      fmt::format("{}: the error that table and plots tell (default rms); the CSV has both",
                  fmt::join(error_measure_names(), " | ")),
      [&call](const std::string& text) { call.error = error_measure_from_name(text); });
}

void add_reference_options(CLI::App& command, StudyCall& call) {
  add_parsed_option(command, "--reference", "M",
                    "compare with M passes of fibonacci, under a rotation of their own (default: "
                    "four times the most that are studied)",
                    [&call](const std::string& text) {
                      call.reference = static_cast<int>(
                          parse_whole_number("--reference", text, 1, max_directions));
                    });
  auto* cache = command
                    .add_option("--cache", call.cache,
                                "keep references there (default: $XDG_CACHE_HOME/transillum or "
                                "~/.cache/transillum); files in it may be deleted at any time")
                    ->type_name("FOLDER");
  command
      .add_flag_callback(
          "--no-cache", [&call] { call.cache.clear(); }, "neither look for references nor keep any")
      ->excludes(cache);
}

}  // namespace

Run add_study_command(CLI::App& program) {
  auto call = std::make_shared<StudyCall>();
  CLI::App& command =
      *program.add_subcommand("study", "Measures the error of B against the number of passes");
  add_scene_argument(command, call->scene);
  add_series_options(command, *call);
  add_error_options(command, *call);
  add_reference_options(command, *call);
  add_scene_options(command, call->scene_options);
  add_machine_limits(command, call->study.solve.memory, call->study.solve.threads);
  command
      .add_option("-o,--out", call->out,
                  "CSV: sampling,directions,passes,rms_error,max_error,bound, seconds,engine,"
                  "resolution (default: a table on standard output)")
      ->type_name("FILE.csv");
  command
      .add_option("--plot", call->plots,
                  "errors against passes, with slopes and the bound; .svg or .png by its ending; "
                  "may be given several times")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_parsed_option(
      command, "--against", "AXIS",
      fmt::format("{}: what the plots show errors against (default passes); "
                  "hemicubes are in those against seconds only",
                  fmt::join(study_axis_names(), " | ")),
      [call](const std::string& text) { call->against = study_axis_from_name(text); });
  command.add_flag("-q,--quiet", call->quiet, "no progress and no table on standard error");
  command.footer(
      "rms_error is the RMS of the error of B over the RMS of B, over patches; max_error the\n"
      "largest over the largest B; bound eq. 37 with eq. 21; seconds processor time, of all\n"
      "threads. Where more than the sampling differs, its name goes on: hammersley/one-way.\n"
      "Ctrl-C saves the points so far and exits with 130.\n"
      "Example: transillum study cornell-box --directions 16..1024 --sampling random,fibonacci \\\n"
      "  --out study.csv --plot study.svg");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
