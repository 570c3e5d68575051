// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "commands.h"
#include "interruption.h"
#include "messages.h"
#include "option_values.h"
#include "output_files.h"
#include "progress_display.h"
#include "transillum/bsp_tree.h"
#include "transillum/engine.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

struct TransfersCall {
  std::string scene;
  SceneOptions scene_options;
  Vec3 direction;
  Engine engine = Engine::fast;
  EngineOptions engine_options;
  std::string out;
};

int run(const TransfersCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  if (!takes_directions(call.engine)) {
    throw InputError(fmt::format("--engine: {} has no directions (try solve, factors or study)",
                                 name_of(call.engine)));
  }
  if (!call.out.empty()) {
    check_output_files({call.out}, call.scene);
  }
  const auto scene = load_scene(call.scene, call.scene_options, cancellation);
  print_warnings(*scene);
  ProgressDisplay progress;
  const auto tree = build_tree(*scene, cancellation, progress);
  const TransferEngine engine = make_engine(call.engine, scene, tree, call.engine_options);
  const Transfers transfers = engine(call.direction, cancellation);
  progress.clear();
  if (call.out.empty()) {
    write_transfers_csv(std::cout, transfers);
  } else {
    write_transfers_csv(call.out, transfers);
  }
  return success;
}

}  // namespace

Run add_transfers_command(CLI::App& program) {
  auto call = std::make_shared<TransfersCall>();
  CLI::App& command =
      *program.add_subcommand("transfers", "Writes the areas A(i,j,omega) of one direction");
  add_scene_argument(command, call->scene);
  add_direction_option(command, call->direction);
  add_engine_options(command, call->engine, call->engine_options);
  add_scene_options(command, call->scene_options);
  command
      .add_option("-o,--out", call->out,
                  "CSV: receiver,source,area in m2 (default: standard output); source -1: no "
                  "patch, or the back side of one")
      ->type_name("FILE.csv");
  command.footer("Example: transillum transfers cornell-box --direction 0,0,1 --out up.csv");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
