// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <memory>
#include <ostream>
#include <utility>

#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/reports/direction_statistics.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

/// Limit of --stats; more directions take minutes.
constexpr int max_measured = 1 << 20;

struct DirectionsCall {
  std::string out;
  CLI::Option* stats = nullptr;
  std::string stats_file;
  RunInput scene;

  const SolveOptions& set() const { return scene.run.solve; }
};

std::vector<std::string> checked_outputs(const DirectionsCall& call) {
  check_seed(call.scene);
  if (is_standard_output(call.out) && call.stats->count() > 0 && call.stats_file.empty()) {
    throw InputError("--out: standard output takes the text of --stats; name a file");
  }
  if (!call.stats_file.empty()) {
    check_statistics_path(call.stats_file);
  }
  std::vector<std::string> files = given_files({call.out, call.stats_file});
  check_output_files(files);
  const bool measured = call.stats->count() > 0;
  if (!call.scene.spec.empty() && !measured) {
    throw InputError("--scene requires --stats");
  }
  if (measured && call.set().directions > max_measured) {
    throw InputError(fmt::format("--stats: {} directions exceed the limit of {}",
                                 call.set().directions, max_measured));
  }
  return files;
}

void measure(const DirectionsCall& call, const std::vector<DirectionSample>& samples,
             const std::vector<std::string>& outputs) {
  const Cancellation& cancellation = cancel_on_signals();
  std::shared_ptr<const Scene> scene;
  if (!call.scene.spec.empty()) {
    scene = load_input_scene(call.scene, outputs, cancellation);
  }
  const auto statistics = measure_directions(call.set(), samples, scene, cancellation);
  if (call.stats_file.empty()) {
    print_results(text_of(statistics));
  } else {
    write_direction_statistics(call.stats_file, statistics);
  }
}

int run(const DirectionsCall& call) {
  const std::vector<std::string> outputs = checked_outputs(call);
  const SolveOptions& set = call.set();
  auto samples = make_directions(set.used_sampling(), set.directions, set.seed);
  if (set.rotation) {
    samples = rotated(std::move(samples), *set.rotation);
  }
  if (call.stats->count() > 0) {
    measure(call, samples, outputs);
  }
  if (call.stats->count() == 0 || !call.out.empty()) {
    write_output(call.out, [&](std::ostream& out) { write_directions_csv(out, samples); });
  }
  return success;
}

}  // namespace

Run add_directions_command(CLI::App& program) {
  auto call = std::make_shared<DirectionsCall>();
  CLI::App& command = *program.add_subcommand(
      "directions", "Writes the points and directions of a sequence, or measures their quality");
  call->scene.command = &command;
  add_options(command, call->scene, {"directions", "sampling", "seed", "rotate"});
  command.add_option("-o,--out", call->out, "CSV: u,v,x,y,z (default: standard output)")
      ->type_name("FILE.csv");
  call->stats =
      command
          .add_option("--stats", call->stats_file,
                      "instead of the points, their discrepancies and quadrature errors eps(M) of "
                      "the cosine, with the paper's bounds; as text on standard output, or as JSON "
                      "in a file")
          ->type_name("[FILE.json]")
          ->expected(0, 1);
  command
      .add_option(
          "--scene", call->scene.spec,
          "with --stats: eps(M) for the normals of this scene's patches instead of all normals")
      ->type_name("SCENE");
  command.footer(
      "A solve takes the same directions in another order, which spreads the first ones evenly: "
      "row\n"
      "37 is not pass 37.\n"
      "Example: transillum directions --sampling hammersley -m 64 --out points.csv\n"
      "         transillum directions -m 1024 --stats --scene cornell-box");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
