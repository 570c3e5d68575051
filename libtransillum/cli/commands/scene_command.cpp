// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "cli/arguments/scene_options.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "transillum/errors.h"
#include "transillum/files.h"

namespace transillum::cli {
namespace {

struct SceneCall {
  SceneInput scene;
  std::string out;
};

int run(const SceneCall& call) {
  const Cancellation& cancellation = cancel_on_signals();
  const std::filesystem::path out = call.out;
  if (out.extension() != ".obj") {
    throw InputError(fmt::format("{}: the name of a scene file must end in .obj", call.out));
  }
  const std::vector<std::string> outputs{call.out, materials_file_of(out).string()};
  check_output_files(outputs);
  const SceneDescription description = describe_input(call.scene, cancellation);
  check_distinct(outputs, description.files);
  for (const std::string& note : description.notes) {
    print_message("warning: " + note);
  }
  write_obj(out, description);
  return success;
}

}  // namespace

Command add_scene_command(CLI::App& program) {
  auto call = std::make_shared<SceneCall>();
  CLI::App& command = *program.add_subcommand("scene", "Writes a scene as .obj and .mtl files");
  add_scene_argument(command, call->scene);
  add_sections(command, call->scene, {"Scene"});
  command.add_option("-o,--out", call->out, "the .obj file; the .mtl file is written next to it")
      ->type_name("FILE.obj")
      ->required();
  command.footer(
      "The file has the scene as the options change it, with its materials and groups.\n"
      "Example: transillum scene sphere-flake:levels=1 --out flake.obj\n"
      "         transillum scene house.obj --units mm --emission lamp=100 --out lit.obj");
  return [call] { return run(*call); };
}

}  // namespace transillum::cli
