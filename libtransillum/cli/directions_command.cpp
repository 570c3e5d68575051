// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <utility>

#include "commands.h"
#include "direction_statistics.h"
#include "interruption.h"
#include "messages.h"
#include "output_files.h"
#include "sequence_options.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

/// Limit of --stats; more directions take minutes.
constexpr int max_measured = 1 << 20;

struct DirectionsCall {
  SequenceOptions sequence;
  std::string out;
  CLI::Option* stats = nullptr;
  std::string stats_file;
  std::string scene;
};

void check_call(const DirectionsCall& call) {
  std::vector<std::string> files;
  if (!call.out.empty()) {
    files.push_back(call.out);
  }
  if (!call.stats_file.empty()) {
    check_statistics_path(call.stats_file);
    files.push_back(call.stats_file);
  }
  check_output_files(files, call.scene);
  const bool measured = call.stats->count() > 0;
  if (!call.scene.empty() && !measured) {
    throw InputError("--scene requires --stats");
  }
  if (measured && call.sequence.directions > max_measured) {
    throw InputError(fmt::format("--stats: {} directions exceed the limit of {}",
                                 call.sequence.directions, max_measured));
  }
}

void measure(const DirectionsCall& call, const std::vector<DirectionSample>& samples) {
  const Cancellation& cancellation = cancel_on_signals();
  std::shared_ptr<const Scene> scene;
  if (!call.scene.empty()) {
    scene = load_scene(call.scene, {}, cancellation);
    print_warnings(*scene);
  }
  const auto statistics = measure_directions(call.sequence, samples, scene, cancellation);
  if (call.stats_file.empty()) {
    fmt::print("{}", text_of(statistics));
  } else {
    write_direction_statistics(call.stats_file, statistics);
  }
}

int run(const DirectionsCall& call) {
  check_call(call);
  const SequenceOptions& sequence = call.sequence;
  auto samples = make_directions(sequence.sampling, sequence.directions, sequence.seed);
  if (sequence.rotation) {
    samples = rotated(std::move(samples), *sequence.rotation);
  }
  if (call.stats->count() > 0) {
    measure(call, samples);
  }
  if (!call.out.empty()) {
    write_directions_csv(call.out, samples);
  } else if (call.stats->count() == 0) {
    write_directions_csv(std::cout, samples);
  }
  return success;
}

}  // namespace

Run add_directions_command(CLI::App& program) {
  auto call = std::make_shared<DirectionsCall>();
  CLI::App& command = *program.add_subcommand(
      "directions", "Writes the points and directions of a sequence, or measures their quality");
  add_sequence_options(command, call->sequence);
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
          "--scene", call->scene,
          "with --stats: eps(M) for the normals of this scene's patches instead of all normals")
      ->type_name("SCENE");
  command.footer(
      "Example: transillum directions --sampling hammersley -m 64 --out points.csv\n"
      "         transillum directions -m 1024 --stats --scene cornell-box");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
