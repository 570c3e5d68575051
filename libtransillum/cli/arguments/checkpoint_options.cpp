// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/arguments/checkpoint_options.h"

#include <fmt/format.h>

#include <filesystem>

#include "cli/messages.h"
#include "transillum/errors.h"

namespace transillum::cli {

CLI::Option* add_checkpoint_options(CLI::App& command, CheckpointCall& call,
                                    const std::string& help) {
  auto* checkpoint = command.add_option("--checkpoint", call.file, help)->type_name("FILE");
  command
      .add_flag("--resume", call.resume,
                "resume the run in the file of --checkpoint, if it is there, to the same bits")
      ->needs(checkpoint);
  return checkpoint;
}

void check_checkpoint(const CheckpointCall& call) {
  std::error_code ignored;  // check_writable() names it
  if (!call.file.empty() && !call.resume && std::filesystem::exists(call.file, ignored)) {
    throw InputError(fmt::format(
        "{}: there is such a file already; resume it by --resume, or delete it", call.file));
  }
}

bool can_resume(const CheckpointCall& call) {
  if (!call.resume) {
    return false;
  }
  std::error_code ignored;
  if (!std::filesystem::exists(call.file, ignored)) {
    print_message(call.file + ": not there yet, so the run begins at its beginning");
    return false;
  }
  return true;
}

}  // namespace transillum::cli
