// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum solve`: the solve with its output files, or the passes of a share.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

#include "base/seconds_since.h"
#include "cli/arguments/solve_call.h"
#include "cli/commands/commands.h"
#include "cli/commands/solve_job.h"
#include "cli/commands/write_pictures.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/processes.h"
#include "cli/progress_display.h"
#include "cli/reports/summaries.h"
#include "io/results/error_report_files.h"
#include "io/results/statistics_files.h"
#include "io/runs/shard_files.h"
#include "options/option_table.h"
#include "radiosity/sun_light.h"
#include "transillum/checkpoint.h"
#include "transillum/files.h"
#include "transillum/glossy.h"

namespace transillum::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// The table of --by, on standard output unless a result is there.
void print_powers(const SolveCall& call, const Solution& solution) {
  const SunLight sun = sun_light(solution.scene, nullptr, {.sky = solution.sky}, {});
  const PowerTable table =
      power_table(solution, *call.by, solution.form_factors.get(), {}, {}, sun.irradiance);
  const std::string text = power_report(table, *call.by) + "\n";
  if (std::any_of(call.out.begin(), call.out.end(), is_standard_output)) {
    print_diagnostics(text);
  } else {
    print_results(text);
  }
}

/// Writes the files and the summary.
void write_outputs(const SolveCall& call, const SolveOptions& options, const Solution& solution,
                   const std::optional<MeasuredErrors>& errors,
                   const std::optional<PatchCosts>& costs,
                   const std::shared_ptr<const LightMap>& sharp_map) {
  std::vector<std::function<void()>> writers;
  DisplayOptions display = call.colors.display;
  display.sharp_map = sharp_map;
  for (const std::string& file : call.out) {
    if (is_picture_file(file)) {
      continue;
    }
    writers.emplace_back([&] {
      if (is_standard_output(file)) {
        print_results([&](std::ostream& out) { write_result_csv(out, solution); });
      } else {
        write_result(file, solution, display);
      }
    });
  }
  if (!call.stats.empty()) {
    RunOptions run = call.scene.run;
    run.solve = options;
    writers.emplace_back([=, &call, &solution, &costs] {
      write_statistics(call.stats, run, solution, costs ? &*costs : nullptr);
    });
  }
  if (errors && !call.error_report.empty()) {
    writers.emplace_back(
        [&] { write_error_report(call.error_report, errors->report, errors->solve); });
  }
  if (call.by) {
    writers.emplace_back([&] { print_powers(call, solution); });
  }
  const std::string summary =
      solve_summary(solution) +
      (errors ? error_summary(errors->report, errors->total) : std::string());
  if (call.out.empty()) {
    writers.emplace_back([&] { print_results(summary); });
  } else if (!call.quiet) {
    writers.emplace_back([&] { print_diagnostics(summary); });
  }
  write_all(writers);
}

/// The map of --sharp; null without it.
/// @throws NothingToSave where it is canceled
std::shared_ptr<const LightMap> sharp_map_of(const SolveCall& call,
                                             const std::shared_ptr<const Solution>& solution,
                                             ProgressDisplay& display,
                                             const Cancellation& cancellation) {
  if (!call.colors.sharp) {
    return nullptr;
  }
  display.begin("light map");
  try {
    const SurfaceLight light(solution, 0, cancellation);
    auto map = std::make_shared<const LightMap>(
        *solution->scene, light,
        LightMap::Options{.density = call.colors.texels, .threads = call.options().threads},
        cancellation, [&](double fraction) { display.show("light map", fraction); });
    display.clear();
    return map;
  } catch (const Canceled&) {
    throw NothingToSave("the light map is not finished: no result is written");
  }
}

/// The pictures among the outputs, seen from --eye.
PictureRequest pictures_of(const SolveCall& call, const Scene& scene) {
  PictureRequest request;
  std::copy_if(call.out.begin(), call.out.end(), std::back_inserter(request.files),
               is_picture_file);
  if (!request.files.empty()) {
    request.camera = {.eye = *call.eye,
                      .target = call.colors.target.value_or(scene.bounds().center()),
                      .up = call.colors.display.up};
    request.exposure = call.colors.display.exposure;
    request.options.threads = call.options().threads;
    request.quiet = call.quiet;
  }
  return request;
}

/// "12.3 MB"
std::string size_text(std::uint64_t bytes) {
  return bytes < 100'000 ? fmt::format("{:.1f} kB", static_cast<double>(bytes) / 1e3)
                         : fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

void print_cost(const SolveCall& call, const Checkpoint& checkpoint) {
  const Checkpoint::Cost& cost = checkpoint.cost();
  if (!call.quiet && cost.times > 0) {
    print_message(
        fmt::format("{}: {}, saved {} in {:.2g} s", call.checkpoint.file, size_text(cost.bytes),
                    cost.times == 1 ? "once" : fmt::format("{} times", cost.times), cost.seconds));
  }
}

/// All that is needed before a solve begins.
struct PreparedCall {
  SolveOptions options;
  std::shared_ptr<const Scene> scene;
  std::optional<ResultSeries> series;
};

PreparedCall prepare_call(SolveCall& call, const Cancellation& cancellation) {
  PreparedCall prepared;
  std::vector<std::string> outputs;
  if (is_first_process()) {
    outputs = checked_outputs(call);
  }
  complete(call);
  prepared.options = call.options();
  prepared.scene = load_input_scene(call.scene, outputs, cancellation, Light::required);
  check_errors_with(call, prepared.options.glossy && has_lobes(*prepared.scene));
  check_series(call.colors, prepared.scene->files());
  check_picture_request(pictures_of(call, *prepared.scene), prepared.scene);
  if (!call.colors.series.empty() && is_first_process()) {
    prepared.series.emplace(call.colors.series);
  }
  return prepared;
}

/// The name of a material that reflects by its lobe only, as a metal does; empty if none does.
std::string metal_of(const Scene& scene) {
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (max_abs(scene.reflectance(i)) == 0 && scene.material(i).lobe.present()) {
      return scene.material(i).name;
    }
  }
  return {};
}

void warn_of_lobes(const Scene& scene, int directions_per_replica) {
  for (const std::string& warning : lobe_warnings(scene, directions_per_replica)) {
    print_message("warning: " + warning);
  }
}

/// Says what about lobes a user may not expect.
void say_of_lobes(const SolveCall& call, const SolveOptions& options, const Scene& scene) {
  const bool present = has_lobes(scene);
  if (options.glossy && !present) {
    print_message("no material has a lobe: --glossy changes nothing");
  } else if (options.glossy) {
    if (!options.goal.is_set()) {  // which chooses the directions
      warn_of_lobes(scene, options.directions / options.replicas);
    }
  } else if (present && !call.quiet) {
    const std::string metal = metal_of(scene);
    print_message(
        "lobes of materials are omitted (--glossy: they reflect too" +
        (metal.empty()
             ? ")"
             : fmt::format("; {0} reflects nothing else: try --reflectance '{0}=0.5')", metal)));
  }
}

/// Whether several processes share the solve. Otherwise the first does it alone.
bool is_shared(const SolveCall& call) {
  return processes().sums && call.factors.empty() && takes_directions(call.options().engine) &&
         !call.options().glossy;
}

/// Shares threads and memory between the processes of a machine, where the options leave them open.
void share_machine(SolveOptions& options) {
  if (options.threads == 0) {
    options.threads = processes().threads;
  }
  if (options.memory == 0) {
    options.memory = default_memory_limit() / static_cast<std::uint64_t>(processes().here);
  }
}

PreparedCall prepare_in_all(SolveCall& call, const Cancellation& cancellation) {
  PreparedCall prepared;
  processes().sums->agree([&] { prepared = prepare_call(call, cancellation); });
  share_machine(prepared.options);
  return prepared;
}

}  // namespace

int run_solve(SolveCall& call) {
  const auto start = Clock::now();
  const bool shared = is_shared(call);
  if (!shared && !is_first_process()) {
    return success;
  }
  const Cancellation& cancellation = cancel_on_signals();
  ProgressDisplay display(call.quiet || !is_first_process());
  PreparedCall prepared =
      shared ? prepare_in_all(call, cancellation) : prepare_call(call, cancellation);
  const SolveOptions& options = prepared.options;
  const double seconds_load = seconds_since(start);
  std::optional<Checkpoint> checkpoint;
  const RefineChoice& refine = call.scene.run.refine;
  std::optional<MeasuredErrors> errors;
  std::optional<PatchCosts> costs;
  const bool measures_costs = !call.stats.empty() && is_first_process();
  const SolveJob job{.scene = prepared.scene,
                     .options = options,
                     .refine = refine.is_set() ? std::optional(refine.options()) : std::nullopt,
                     .cancellation = cancellation,
                     .display = display,
                     .quiet = call.quiet,
                     .factors = call.factors,
                     .form_factors = call.by.has_value(),
                     .has_series = !call.colors.series.empty(),
                     .series = prepared.series ? &*prepared.series : nullptr,
                     .series_every = call.colors.series_every,
                     .checkpoint = call.checkpoint,
                     .checkpoint_every = call.checkpoint_every,
                     .shards = call.shards,
                     .total = total_goal(call.scene.run),
                     .errors = measures_errors(call) ? &errors : nullptr,
                     .costs = measures_costs ? &costs : nullptr,
                     .sums = shared ? processes().sums : nullptr};
  say_of_lobes(call, options, *prepared.scene);
  Solution solution = run_job(job, checkpoint);
  display.clear();
  solution.statistics.seconds_load = seconds_load;
  solution.statistics.seconds_total = seconds_since(start) - (costs ? costs->seconds : 0);
  solution.eye = call.eye;
  for (const std::string& warning : solve_warnings(solution)) {
    print_message("warning: " + warning);
  }
  if (solution.statistics.glossy.patches > 0 && options.goal.is_set()) {
    warn_of_lobes(*solution.scene,
                  solution.statistics.passes / std::max(solution.error.replicas, 1));
  }
  if (shared && !call.quiet) {
    print_message(processes().traffic());
  }
  const bool complete = solution.complete;
  if (is_first_process()) {
    const auto shown = std::make_shared<const Solution>(std::move(solution));
    // An interruption before, of a measurement, leaves the rest to be written.
    const bool stops = complete && !cancellation.canceled();
    const Cancellation stop = stops ? cancellation : Cancellation();
    const auto sharp_map = sharp_map_of(call, shown, display, stop);
    write_all({[&] { write_outputs(call, options, *shown, errors, costs, sharp_map); },
               [&] { write_pictures(pictures_of(call, *shown->scene), shown, display, stop); }});
  }
  if (checkpoint) {
    print_cost(call, *checkpoint);
  }
  if (complete) {
    return success;
  }
  print_message(call.out.empty() && call.stats.empty()
                    ? "interrupted; the summary is of the estimate so far"
                    : "interrupted; the results so far are saved");
  return interrupted;
}

int run_shard(SolveCall& call) {
  const std::vector<std::string> outputs = checked_outputs(call);
  complete(call);
  const SolveOptions& options = call.options();
  check_can_be_shared(options, *call.share);
  const Cancellation& cancellation = cancel_on_signals();
  ProgressDisplay display(call.quiet);
  const auto scene = load_input_scene(call.scene, outputs, cancellation, Light::required);
  const auto start = Clock::now();
  const int passes = (options.directions - call.share->number) / call.share->of + 1;
  int done = 0;
  try {
    const auto tree = build_tree(*scene, cancellation, display, options.threads);
    display.begin("passes");
    const auto show = [&](int count) {
      done = count;
      display.show_rate("passes", count / static_cast<double>(passes), passes, "passes");
    };
    write_shard(call.out.front(), scene, options, tree,
                {*call.share, stored_arguments(*call.scene.command), show}, cancellation);
  } catch (const Canceled&) {
    throw NothingToSave(
        fmt::format("{} of {} passes were made, but a shard has all of its share: nothing is saved",
                    done, passes));
  }
  display.clear();
  if (!call.quiet) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(call.out.front(), error);
    print_message(fmt::format("{}: share {} of the passes, {} of {}, in {:.3g} s; {}",
                              call.out.front(), call.share->text(), passes, options.directions,
                              seconds_since(start), size_text(error ? 0 : size)));
  }
  return success;
}

Command add_solve_command(CLI::App& program) {
  auto call = std::make_shared<SolveCall>();
  CLI::App& command = *program.add_subcommand("solve", "Computes the radiosity of every patch");
  add_solve_options(command, *call);
  command.footer(
      "Columns: face,patch,area,E_r,E_g,E_b,rho_r,rho_g,rho_b,B_r,B_g,B_b,H_r,H_g,H_b,F_sum,sky,\n"
      "group,material; areas in m2, exitance E, radiosity B and irradiance H in W/m2.\n"
      "Ctrl-C saves the results so far and exits with status 130; pressed twice, it exits "
      "immediately.\n"
      "One solve on four machines: --shard 1/4 --out part1.tsh on the first, and so on; then "
      "merge.\n"
      "Example: transillum solve cornell-box --max-patch-area 0.01 -m 256 --out cornell.vtp");
  return [call] {
    set_up_of_display(*call->scene.command, call->options().sky, call->colors);
    if (call->share) {
      return is_first_process() ? run_shard(*call) : success;
    }
    return run_solve(*call);
  };
}

}  // namespace transillum::cli
