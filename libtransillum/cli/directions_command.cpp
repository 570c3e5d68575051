// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <iostream>
#include <memory>

#include "commands.h"
#include "sequence_options.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

struct DirectionsCall {
  SequenceOptions sequence;
  std::string out;
};

int run(const DirectionsCall& call) {
  if (!call.out.empty()) check_writable(call.out);
  const SequenceOptions& sequence = call.sequence;
  auto samples = make_directions(sequence.sampling, sequence.directions, sequence.seed);
  if (sequence.rotation) samples = rotated(std::move(samples), *sequence.rotation);
  if (call.out.empty()) {
    write_directions_csv(std::cout, samples);
  } else {
    write_directions_csv(call.out, samples);
  }
  return success;
}

}  // namespace

Run add_directions_command(CLI::App& program) {
  auto call = std::make_shared<DirectionsCall>();
  CLI::App& command =
      *program.add_subcommand("directions", "Writes the points of a sequence and their directions");
  add_sequence_options(command, call->sequence);
  command.add_option("-o,--out", call->out, "CSV: u,v,x,y,z (default: to standard output)")
      ->type_name("FILE.csv");
  command.footer("Example: transillum directions --sampling hammersley -m 64 --out points.csv");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
