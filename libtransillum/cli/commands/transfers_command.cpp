// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <memory>
#include <ostream>

#include "cli/arguments/option_values.h"
#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/progress_display.h"
#include "transillum/bsp_tree.h"
#include "transillum/engine.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

struct TransfersCall {
  SceneInput scene;
  Vec3 direction;
  std::string out;
};

int run(const TransfersCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  const SolveOptions& options = call.scene.run.solve;
  if (!takes_directions(options.engine)) {
    throw InputError(fmt::format("--engine: {} has no directions (try solve, factors or study)",
                                 name_of(options.engine)));
  }
  refuse_unused(call.scene, {call.scene.run});
  const std::vector<std::string> outputs = given_files({call.out});
  check_output_files(outputs);
  const auto scene = load_input_scene(call.scene, outputs, cancellation);
  ProgressDisplay progress;
  const auto tree = build_tree(*scene, cancellation, progress, options.threads);
  const TransferEngine engine = make_engine(options.engine, scene, tree, options.engine_options);
  const Transfers transfers = engine(call.direction, cancellation);
  progress.clear();
  write_output(call.out, [&](std::ostream& out) { write_transfers_csv(out, transfers); });
  return success;
}

}  // namespace

Command add_transfers_command(CLI::App& program) {
  auto call = std::make_shared<TransfersCall>();
  CLI::App& command =
      *program.add_subcommand("transfers", "Writes the areas A(i,j,omega) of one direction");
  add_scene_argument(command, call->scene);
  add_direction_option(command, call->direction);
  add_sections(command, call->scene, {"Engine"});
  add_scene_options(command, call->scene);
  add_options(command, call->scene, {"threads"});
  command
      .add_option("-o,--out", call->out,
                  "CSV: receiver,source,area in m2 (default: standard output); source -1: no "
                  "patch, or the back side of one")
      ->type_name("FILE.csv");
  command.footer("Example: transillum transfers cornell-box --direction 0,0,1 --out up.csv");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
