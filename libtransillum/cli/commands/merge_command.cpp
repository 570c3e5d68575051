// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// `transillum merge`: one result from the shards of `solve --shard`. It runs `solve` with the
// options that the shards have stored, and with their passes.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/arguments/solve_call.h"
#include "cli/commands/commands.h"
#include "io/runs/shard_files.h"
#include "transillum/errors.h"

namespace transillum::cli {
namespace {

struct MergeCall {
  const CLI::App* command = nullptr;
  std::vector<std::string> parts;
  std::string scene;  ///< instead of the one that the shards name, if not empty
  SolveCall outputs;  ///< only add_output_options() and the colors
};

/// The arguments of the solve that the shards are of, with the outputs of this call.
std::vector<std::string> solve_arguments(const MergeCall& call) {
  std::vector<std::string> arguments = read_shard_info(call.parts.front()).notes;
  const auto is_value = [](const std::string& argument) { return argument.rfind("--", 0) != 0; };
  const auto scene = std::find_if(arguments.begin(), arguments.end(), is_value);
  if (scene == arguments.end()) {
    throw InputError(fmt::format("{}: the shard does not name its scene", call.parts.front()));
  }
  if (!call.scene.empty()) {
    *scene = call.scene;
  }
  std::vector<std::string> outputs = given_options(*call.command);
  std::erase_if(outputs,
                [](const std::string& argument) { return argument.rfind("--scene=", 0) == 0; });
  arguments.insert(arguments.end(), outputs.begin(), outputs.end());
  return arguments;
}

int merge(const MergeCall& call) {
  SolveCall solve;
  CLI::App command("solve");
  add_solve_options(command, solve);
  std::vector<std::string> arguments = solve_arguments(call);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes a vector back to front
  try {
    command.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    throw InputError(
        fmt::format("{}: its options cannot be read: {}", call.parts.front(), error.what()));
  }
  set_up_of_display(command, solve.options().sky, solve.colors);
  solve.shards = call.parts;
  return run_solve(solve);
}

}  // namespace

Command add_merge_command(CLI::App& program) {
  auto call = std::make_shared<MergeCall>();
  CLI::App& command = *program.add_subcommand(
      "merge", "Computes one result from the shards that solve --shard has written");
  call->command = &command;
  command.add_option("PART", call->parts, "the shards, all of one solve")
      ->required()
      ->type_name("FILE.tsh");
  command
      .add_option("--scene", call->scene,
                  "the scene, where it is not at the place that the shards name")
      ->type_name("SCENE");
  add_output_options(command, call->outputs);
  command.footer(
      "The result has the bits of one solve that makes all passes itself. The scene is read "
      "again;\n"
      "it must be the same.\n"
      "Example: transillum merge part*.tsh --out result.vtp");
  return [call] { return merge(*call); };
}

}  // namespace transillum::cli
