// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/arguments/solve_call.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>

#include "cli/arguments/option_values.h"
#include "cli/output_files.h"
#include "cli/processes.h"
#include "io/results/error_report_files.h"
#include "session/measure_errors.h"
#include "transillum/errors.h"
#include "transillum/files.h"

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
  const bool has_picture = std::any_of(call.out.begin(), call.out.end(), is_picture_file);
  refuse_unless(call.options().glossy || has_picture, *call.scene.command, "--eye",
                "used only with --glossy, or a .png, .exr or .pfm file");
  refuse_unless(has_picture || any_file({".csv", ".vtp", ".ply"}), *call.scene.command, "--eye",
                "used only with a .csv, .vtp, .ply, .png, .exr or .pfm file");
  if (call.options().glossy) {
    for (const char* option : {"--factors", "--by", "--series", "--checkpoint", "--shard"}) {
      refuse_unless(false, *call.scene.command, option, "not used with --glossy");
    }
  }
}

/// Refuses options that say how form factors are computed.
void check_stored_factors(const SolveCall& call) {
  if (call.factors.empty()) {
    return;
  }
  for (const std::string& name : call.scene.given) {
    if (!option(name).reads_factors) {
      throw InputError(fmt::format("--{}: not used with --factors", name));
    }
  }
}

void add_outputs(CLI::App& command, SolveCall& call) {
  command
      .add_option("-o,--out", call.out,
                  "result file: .csv, .vtp, .ply, .glb, .gltf or, with --eye, a picture: .png, "
                  ".exr, .pfm, by its ending, or - for CSV on standard output; may be given "
                  "several times (default: a "
                  "summary on standard output)")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  command
      .add_option("--stats", call.stats,
                  "statistics: counts, times, change per iteration, closure and energy defects")
      ->type_name("FILE.json");
  command
      .add_option(
          "--error-report", call.error_report,
          "measure the errors of each surface by directions, patches, iterations and method, "
          "which takes about five times as long, and write them with the cheapest next step")
      ->type_name("FILE.html|.json");
  add_color_outputs(command, call.colors);
  add_parsed_option(command, "--by", "NAME",
                    fmt::format("print area and power emitted, received, absorbed, escaped and "
                                "exchanged, by {}",
                                fmt::join(names_of<SurfaceKind>(), " or ")),
                    [&call](const std::string& text) { call.by = from_name<SurfaceKind>(text); });
  command.add_flag("-q,--quiet", call.quiet, "no progress and no summary on standard error");
  for (const char* option : {"--exposure", "--target", "--light-map", "--series", "--series-every",
                             "--by", "--error-report"}) {
    command.get_option(option)->group("Results");
  }
}

void add_runs(CLI::App& command, SolveCall& call) {
  auto* checkpoint = add_checkpoint_options(
      command, call.checkpoint,
      "save the run in this file every minute and at its end, so that --resume can continue it");
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
    refuse_unless(false, *call.scene.command, option, "not used with --shard; `merge` takes it");
  }
}

/// Refuses what rounds of refinement cannot have.
void check_refinement(const SolveCall& call) {
  if (!call.scene.run.refine.is_set()) {
    return;
  }
  refuse_unless(!call.share, *call.scene.command, "--shard", "not used with --refine-by");
  refuse_unless(!processes().sums, *call.scene.command, "--refine-by",
                "not available with several processes");
}

const char* errors_option(const SolveCall& call) {
  return call.scene.run.total ? "--total" : "--error-report";
}

/// Refuses errors by cause that cannot be measured.
void check_errors(const SolveCall& call) {
  if (!measures_errors(call)) {
    return;
  }
  const CLI::App& command = *call.scene.command;
  const char* option = errors_option(call);
  refuse_unless(!processes().sums, command, option, "not available with several processes");
  refuse_unless(call.shards.empty() && !call.share, command, option, "not available with shards");
  refuse_unless(call.factors.empty(), command, option, "not used with --factors");
  refuse_unless(takes_directions(call.options().engine), command, option,
                fmt::format("not used with engine {}", name_of(call.options().engine)));
  check_errors_with(call, false);
  if (call.error_report.empty()) {
    return;
  }
  if (is_standard_output(call.error_report)) {
    throw InputError(
        "--error-report: standard output (-) takes only the CSV of --out; name a file");
  }
  check_error_report_path(call.error_report);
}

/// Refuses checkpoints where there are no passes.
void check_run(const SolveCall& call) {
  check_checkpoint(call.checkpoint);
  if (call.checkpoint.file.empty()) {
    return;
  }
  refuse_unless(call.factors.empty(), *call.scene.command, "--checkpoint",
                "not used with --factors");
  refuse_unless(takes_directions(call.options().engine), *call.scene.command, "--checkpoint",
                fmt::format("not used with engine {}", name_of(call.options().engine)));
}

}  // namespace

bool measures_errors(const SolveCall& call) {
  return call.scene.run.total || !call.error_report.empty();
}

void check_errors_with(const SolveCall& call, bool lobes_take_part) {
  if (measures_errors(call)) {
    try {
      check_measurable(call.options(), lobes_take_part);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", errors_option(call), error.what()));
    }
  }
}

std::vector<std::string> checked_outputs(const SolveCall& call) {
  if (std::count_if(call.out.begin(), call.out.end(), is_standard_output) > 1) {
    throw InputError("--out: standard output (-) is given twice");
  }
  check_share(call);
  check_refinement(call);
  check_run(call);
  check_errors(call);
  std::vector<std::string> files = given_files(call.out);
  if (!call.share) {
    for (const std::string& file : files) {
      if (is_picture_file(file)) {
        check_picture_path(file);
      } else {
        check_result_path(file);
      }
    }
  }
  if (!call.stats.empty()) {
    if (is_standard_output(call.stats)) {
      throw InputError("--stats: standard output (-) takes only the CSV of --out; name a file");
    }
    check_statistics_path(call.stats);
    files.push_back(call.stats);
  }
  if (!call.error_report.empty()) {
    files.push_back(call.error_report);
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

void complete(SolveCall& call) {
  check_glossy(call);
  check_stored_factors(call);
  if (!call.factors.empty() || call.share || !call.shards.empty()) {
    call.scene.offered.erase("accuracy");
  }
  complete(static_cast<GivenOptions&>(call.scene));
  check_color_outputs(*call.scene.command, call.colors, call.out, call.options());
}

void add_output_options(CLI::App& command, SolveCall& call) {
  add_sections(command, call.scene, {"Machine"});
  add_outputs(command, call);
}

void add_solve_options(CLI::App& command, SolveCall& call) {
  add_scene_argument(command, call.scene);
  add_sections(
      command, call.scene,
      {"Directions", "Engine", "Iteration", "Accuracy", "Scene", "Patches", "Refinement", "Sky"});
  command.get_option("--up")->description(
      "the vertical: the zenith of the sky cie-overcast (default 0,0,1) and of the sun's azimuth "
      "and elevation, which require it; the direction that becomes up, +y, in "
      ".glb and .gltf files (default 0,1,0: coordinates stay) and is up in pictures (default "
      "0,0,1)");
  add_parsed_option(
      command, "--eye", "X,Y,Z",
      "a point in m: with --glossy, .csv, .vtp and .ply files have the radiance toward it; "
      "pictures are seen from it (`picture` has more options)",
      [&call](const std::string& text) { call.eye = parse_point("--eye", text); })
      ->group("Results");
  command
      .add_option("--factors", call.factors,
                  "iterate with the form factors in this file, .npz or .mtx, instead of computing "
                  "them; it is checked against the scene")
      ->type_name("FILE");
  add_runs(command, call);
  add_output_options(command, call);
  for (const char* option :
       {"--factors", "--checkpoint", "--checkpoint-every", "--resume", "--shard"}) {
    command.get_option(option)->group("Long runs");
  }
}

}  // namespace transillum::cli
