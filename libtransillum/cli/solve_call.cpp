// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "solve_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>

#include "option_values.h"
#include "output_files.h"
#include "processes.h"
#include "transillum/errors.h"
#include "transillum/files.h"
#include "transillum/study.h"

namespace transillum::cli {
namespace {

/// Refuses what a solve in which lobes take part does not have.
void check_glossy(const SolveCall& call) {
  const auto any_file = [&call](std::initializer_list<const char*> endings) {
    return std::any_of(call.out.begin(), call.out.end(), [&](const std::string& file) {
      const std::string ending =
          is_standard_output(file) ? ".csv" : std::filesystem::path(file).extension().string();
      return std::find(endings.begin(), endings.end(), ending) != endings.end();
    });
  };
  refuse_unless(call.options.glossy || any_file({".png"}), *call.command, "--eye",
                "used only with --glossy, or a .png file");
  refuse_unless(any_file({".csv", ".vtp", ".ply", ".png"}), *call.command, "--eye",
                "used only with a .csv, .vtp, .ply or .png file");
  if (call.options.glossy) {
    for (const char* option :
         {"--factors", "--by", "--series", "--checkpoint", "--shard", "--refine-by"}) {
      refuse_unless(false, *call.command, option, "not used with --glossy");
    }
  }
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
        "--basis",      "--memory"}) {
    refuse_unless(false, *call.command, option, "not used with --factors");
  }
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
  add_parsed_option(command, "--basis", "NAME", help_of("basis", name_of(options.basis)),
                    [&options](const std::string& text) { options.basis = basis_from_name(text); });
  auto* glossy = command.add_flag("--glossy", options.glossy, description_of("glossy"));
  command
      .add_flag("--diffuse-only", call.diffuse_only,
                "leave lobes of materials out, as without --glossy, and do not mention them")
      ->excludes(glossy);
  add_parsed_option(
      command, "--eye", "X,Y,Z",
      "a point in m: with --glossy, .csv, .vtp and .ply files have the radiance toward it; .png "
      "files are seen from it",
      [&call](const std::string& text) { call.eye = parse_point("--eye", text); });
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

void add_refinement(CLI::App& command, SolveCall& call) {
  auto* by = add_parsed_option(command, "--refine-by", "NAME", description_of("refine-by"),
                               [&call](const std::string& text) {
                                 call.refine_by = refine_by_from_name(text);
                                 call.scene.in_rounds = true;
                               });
  add_parsed_option(command, "--refine-until", "P%|X", description_of("refine-until"),
                    [&call](const std::string& text) {
                      call.refine_until = parse_accuracy("--refine-until", text);
                    })
      ->needs(by);
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
      .add_option("-o,--out", call.out,
                  "result file: .csv, .vtp, .ply, .obj, .glb, .gltf or, with --eye, .png, by its "
                  "ending, or - for CSV on "
                  "standard output; "
                  "may be given several times "
                  "(default: a summary on standard output)")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
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

void add_runs(CLI::App& command, SolveCall& call) {
  auto* checkpoint = add_checkpoint_options(
      command, call.checkpoint,
      "save the run in this file every minute and at its end, so that --resume can go on with it");
  add_parsed_option(
      command, "--checkpoint-every", "S",
      fmt::format("seconds between two saves of --checkpoint (default {:g}); longer "
                  "where saving would take more than 1 % of the time; 0: after "
                  "every pass",
                  call.checkpoint_every),
      [&call](const std::string& text) {
        call.checkpoint_every = parse_number("--checkpoint-every", text);
        if (!(call.checkpoint_every >= 0)) {
          throw InputError(fmt::format("--checkpoint-every: \"{}\" is below 0", text));
        }
      })
      ->needs(checkpoint);
  add_parsed_option(command, "--shard", "K/N",
                    "make only the K-th of N equal shares of the passes and write them to --out "
                    "FILE.tsh, for `merge`",
                    [&call](const std::string& text) {
                      try {
                        call.share = share_from_text(text);
                      } catch (const InputError& error) {
                        throw InputError(fmt::format("--shard: {}", error.what()));
                      }
                    });
}

/// Refuses what a share of the passes cannot have.
void check_share(const SolveCall& call) {
  const bool shard_file =
      call.out.size() == 1 && std::filesystem::path(call.out.front()).extension() == ".tsh";
  if (!call.share) {
    for (const std::string& file : call.out) {
      if (std::filesystem::path(file).extension() == ".tsh") {
        throw InputError(fmt::format("{}: a shard is written with --shard K/N", file));
      }
    }
    return;
  }
  if (!shard_file) {
    throw InputError("--shard: requires --out FILE.tsh, once, and no other result");
  }
  for (const char* option :
       {"--stats", "--by", "--series", "--checkpoint", "--factors", "--exposure", "--light-map"}) {
    refuse_unless(false, *call.command, option, "not used with --shard; `merge` takes it");
  }
}

/// Refuses what rounds of refinement cannot have.
void check_refinement(const SolveCall& call) {
  if (!call.refine_by) {
    return;
  }
  if (call.scene.patches == 0) {
    throw InputError("--refine-by: requires --patches N, the most patches to make");
  }
  for (const char* option : {"--shard", "--factors", "--seconds"}) {
    refuse_unless(false, *call.command, option, "not used with --refine-by");
  }
  refuse_unless(takes_directions(call.options.engine), *call.command, "--refine-by",
                fmt::format("not used with engine {}", name_of(call.options.engine)));
  refuse_unless(!processes().group, *call.command, "--refine-by",
                "not available with several processes");
}

/// Refuses checkpoints where there are no passes.
void check_run(const SolveCall& call) {
  check_checkpoint(call.checkpoint);
  if (call.checkpoint.file.empty()) {
    return;
  }
  refuse_unless(call.factors.empty(), *call.command, "--checkpoint", "not used with --factors");
  refuse_unless(takes_directions(call.options.engine), *call.command, "--checkpoint",
                fmt::format("not used with engine {}", name_of(call.options.engine)));
}

}  // namespace

std::vector<std::string> checked_outputs(const SolveCall& call) {
  if (std::count_if(call.out.begin(), call.out.end(), is_standard_output) > 1) {
    throw InputError("--out: standard output (-) is given twice");
  }
  check_share(call);
  check_refinement(call);
  check_run(call);
  std::vector<std::string> files = given_files(call.out);
  if (!call.share) {
    for (const std::string& file : files) {
      check_result_path(file);
    }
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
  if (!call.checkpoint.file.empty()) {
    files.push_back(call.checkpoint.file);
  }
  check_output_files(files);
  check_distinct(files, call.shards);
  if (!call.factors.empty()) {
    check_distinct(files, {call.factors});
  }
  check_series(call.colors, files);
  check_series(call.colors, call.shards);
  check_series(call.colors, given_files({call.factors}));
  return files;
}

SolveOptions solve_options(const SolveCall& call) {
  check_glossy(call);
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
  if (options.goal.set() && !call.shot_given && takes_directions(options.engine) &&
      options.basis == Basis::constant) {
    options.first_shot = first_shot_where_it_pays;
  }
  options.validate();
  refuse_unused(*call.command, {options});
  check_color_outputs(*call.command, call.colors, call.out, options);
  return options;
}

void add_output_options(CLI::App& command, SolveCall& call) {
  add_machine_limits(command, call.options.memory, call.options.threads);
  add_outputs(command, call);
}

void add_solve_options(CLI::App& command, SolveCall& call) {
  call.command = &command;
  add_scene_argument(command, call.scene);
  add_sequence_options(command, call.sequence);
  add_estimator(command, call);
  add_scheme(command, call);
  add_refinement(command, call);
  add_goal(command, call.options.goal);
  add_stopping_rules(command, call);
  add_scene_options(command, call.scene);
  add_sky_options(command, call.options.sky);
  command
      .add_option("--factors", call.factors,
                  "iterate with the form factors in this file, .npz or .mtx, instead of computing "
                  "them; it is checked against the scene")
      ->type_name("FILE");
  add_runs(command, call);
  add_output_options(command, call);
}

}  // namespace transillum::cli
