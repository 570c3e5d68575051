// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// Finds the command, runs it, reports errors as one line and gives the exit status.
#include "cli/program.h"

#include <execinfo.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <new>

#include "base/did_you_mean.h"
#include "cli/arguments/help_format.h"
#include "cli/commands/commands.h"
#include "cli/interruption.h"
#include "cli/messages.h"
#include "cli/output_files.h"
#include "cli/processes.h"
#include "transillum/errors.h"
#include "transillum/patch_sums.h"
#include "transillum/scene.h"

namespace transillum::cli {
namespace {

/// Opens /dev/null in place of closed standard streams. Otherwise a file opened later could get the
/// number of one, and messages would be written to it. The access mode is the wrong one, so using
/// such a stream still fails.
void occupy_closed_streams() {
  for (int stream = 0; stream < 3; ++stream) {
    if (::fcntl(stream, F_GETFD) < 0) {
      ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
    }
  }
}

/// Loads what glibc needs to end a thread early or to unwind; without memory for it, glibc would
/// end the program.
void load_unwinder() {
  void* frame = nullptr;
  ::backtrace(&frame, 1);
}

std::string built_in_text(const BuiltInScene& scene) {
  constexpr std::size_t width = 80;
  constexpr const char* indent = "\n                 ";
  std::string text = scene.summary;
  if (!scene.parameters.empty()) {
    text += " Parameters: " + scene.parameters;
  }
  text = wrapped(text, width);
  for (std::size_t end = 0; (end = text.find('\n', end)) != std::string::npos; ++end) {
    text.replace(end, 1, indent);
  }
  return fmt::format("  {:<14} {}\n", scene.name, text);
}

std::string program_footer() {
  std::string text = "Built-in scenes (parameters follow a colon, as in rooms:n=50,seed=2):\n";
  for (const BuiltInScene& scene : built_in_scenes()) {
    text += built_in_text(scene);
  }
  text +=
      "\nExit status: 0 success; 2 invalid arguments or input; 1 any other failure; 130 "
      "interrupted.\n"
      "Example: transillum solve sphere-flake:levels=1 -m 64";
  return text;
}

struct Program {
  CLI::App app{"Radiosity of polygonal scenes by the transillumination method"};
  std::vector<std::pair<CLI::App*, Command>> commands;

  Program() {
    app.name("transillum");
    app.set_version_flag("--version", "transillum " TRANSILLUM_VERSION);
    app.require_subcommand(1);
    app.formatter(std::make_shared<HelpFormat>());
    for (auto add :
         {add_scene_command, add_solve_command, add_picture_command, add_transfers_command,
          add_map_command, add_factors_command, add_directions_command, add_bounds_command,
          add_study_command, add_compare_command, add_info_command, add_merge_command,
          add_shading_command}) {
      Command run = add(app);
      CLI::App& command = *app.get_subcommands({}).back();
      if (command.get_groups().size() > 2) {  // one of them has the arguments
        command.set_help_all_flag("--help-all", "show all options, by group");
      }
      commands.emplace_back(&command, std::move(run));
    }
    app.footer(program_footer());
  }

  std::vector<std::string> command_names() const {
    std::vector<std::string> names;
    for (const auto& [command, run] : commands) {
      names.push_back(command->get_name());
    }
    return names;
  }
  const std::pair<CLI::App*, Command>* chosen() const {
    for (const auto& entry : commands) {
      if (entry.first->parsed()) {
        return &entry;
      }
    }
    return nullptr;
  }
};

bool takes_vector(const std::string& option) {
  return option == "--direction" || option == "--up" || option == "--eye" || option == "--target" ||
         option == "--camera-up";
}

/// Joins options of vectors and their values by =, since a value such as -.5,0,1 would be taken for
/// an option.
std::vector<std::string> joined_directions(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int k = 1; k < argc; ++k) {
    if (!arguments.empty() && takes_vector(arguments.back())) {
      arguments.back() += std::string("=") + argv[k];
    } else {
      arguments.emplace_back(argv[k]);
    }
  }
  return arguments;
}

/// Replaces `help` and `help solve` by `--help` and `solve --help`.
void replace_help_command(std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments[0] != "help") {
    return;
  }
  arguments.erase(arguments.begin());
  arguments.resize(std::min<std::size_t>(arguments.size(), 1));
  arguments.emplace_back("--help");
}

/// Suggests the nearest command or option for an unknown first word; CLI11 does not.
void check_first_word(const Program& program, const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    return;
  }
  const std::string& word = arguments[0];
  const bool option = !word.empty() && word[0] == '-';
  const std::vector<std::string> names =
      option ? std::vector<std::string>{"-h", "--help", "--version"} : program.command_names();
  if (std::find(names.begin(), names.end(), word) != names.end()) {
    return;
  }
  const std::string hint = did_you_mean(word, names);
  throw InputError(
      fmt::format("unknown {} \"{}\"{}", option ? "option" : "command", word,
                  hint.empty() ? fmt::format("; choose one of {}", fmt::join(names, ", ")) : hint));
}

std::string unexpected_argument_text(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining(true);
  if (rest.empty()) {
    return "unexpected argument";
  }
  // The value of an unknown option may be among the rest, too; report the option.
  const auto option = std::find_if(rest.begin(), rest.end(),
                                   [](const auto& word) { return word.rfind("--", 0) == 0; });
  if (option == rest.end()) {
    return fmt::format("unexpected argument \"{}\"", rest.front());
  }
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options()) {
    for (const std::string& name : known->get_lnames()) {
      names.push_back("--" + name);
    }
  }
  const std::string word = option->substr(0, option->find('='));
  return fmt::format("unknown option \"{}\"{}", word, did_you_mean(word, names));
}

/// The message for an option that was given several times.
std::string repeated_option_text(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const auto given = static_cast<int>(option->results().size());
    const int most = option->get_items_expected_max();  // 0 for a flag
    if (most > 0 && given > most) {
      return fmt::format("{}: given {} times, but it has one value", option->get_name(), given);
    }
  }
  return {};
}

/// Prints an error of CLI11 as one line, with a reference to the help.
int report(const Program& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    print_results([&](std::ostream& out) { program.app.exit(error, out); });  // --help, --version
    return success;
  }
  const auto* chosen = program.chosen();
  const CLI::App& command = chosen ? *chosen->first : program.app;
  const bool unexpected = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const std::string repeated = repeated_option_text(command);
  const std::string text = unexpected          ? unexpected_argument_text(command)
                           : !chosen           ? std::string("no command given")
                           : !repeated.empty() ? repeated
                                               : std::string(error.what());
  print_message(fmt::format("{} (see transillum {}--help)", text,
                            chosen ? command.get_name() + " " : std::string()));
  return wrong_call;
}

/// Refuses empty values, as in --out "": they would be taken for options that are not given.
void check_values(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (option->get_items_expected_min() > 0 &&
        std::find(values.begin(), values.end(), "") != values.end()) {
      throw InputError(option->get_name() + ": the value is empty");
    }
  }
}

int run(int argc, char** argv) {
  Program program;
  std::vector<std::string> arguments = joined_directions(argc, argv);
  replace_help_command(arguments);
  check_first_word(program, arguments);
  std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 expects
  try {
    program.app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return report(program, error);
  }
  const auto& [command, run_command] = *program.chosen();
  check_values(*command);
  const bool is_shared = command->get_name() == "solve";
  return is_shared || is_first_process() ? run_command() : success;
}

}  // namespace

void with_definitions(const std::function<void(const CLI::App&)>& use) { use(Program().app); }

void prepare_process() {
  occupy_closed_streams();
  load_unwinder();
  // A closed pipe and a file over the limit of `ulimit -f` are write errors; they must not end the
  // program before the other results are saved.
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
}

int run_program(int argc, char** argv, void (*report)(std::string_view) noexcept) {
  try {
    const int status = run(argc, argv);
    if (status == success) {
      flush_results();
    }
    return status;
  } catch (const OtherProcessFailed&) {
    return failed_elsewhere;
  } catch (const InputError& error) {
    report(error.what());
    return wrong_call;
  } catch (const NothingToSave& interruption) {
    report(std::string("interrupted; ") + interruption.what());
    return interrupted;
  } catch (const Canceled&) {
    report("interrupted; nothing to save yet");
    return interrupted;
  } catch (const std::bad_alloc&) {
    report("not enough memory");  // no string is made here, which could fail again
    return failure;
  } catch (const std::exception& error) {
    if (is_closed_pipe(error)) {
      return success;  // `head` has what it asked for
    }
    report(error_text(error));
    return failure;
  }
}

}  // namespace transillum::cli
