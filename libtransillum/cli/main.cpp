// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <iostream>
#include <system_error>

#include "commands.h"
#include "help_format.h"
#include "interruption.h"
#include "messages.h"
#include "transillum/did_you_mean.h"
#include "transillum/errors.h"
#include "transillum/scene.h"

namespace transillum::cli {
namespace {

/// Without this a file opened later could get the number of a closed standard stream, and
/// messages would end up in it. Opened the wrong way round, so that using one still fails.
void occupy_closed_streams() {
  for (int stream = 0; stream < 3; ++stream) {
    if (::fcntl(stream, F_GETFD) < 0) {
      ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY);
    }
  }
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
      "\nExit status: 0; 2 for a wrong call or bad input; 1 for any other failure; 130 when\n"
      "interrupted.\n"
      "Example: transillum solve sphere-flake:levels=1 -m 64";
  return text;
}

struct Program {
  CLI::App app{"Diffuse light in scenes of polygons by the transillumination method"};
  std::vector<std::pair<CLI::App*, Run>> commands;

  Program() {
    app.name("transillum");
    app.set_version_flag("--version", "transillum " TRANSILLUM_VERSION);
    app.require_subcommand(1);
    app.formatter(std::make_shared<HelpFormat>());
    for (auto add : {add_scene_command, add_solve_command, add_transfers_command, add_map_command,
                     add_factors_command, add_directions_command, add_bounds_command,
                     add_study_command, add_info_command}) {
      Run run = add(app);
      commands.emplace_back(app.get_subcommands({}).back(), std::move(run));
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
  const std::pair<CLI::App*, Run>* chosen() const {
    for (const auto& entry : commands) {
      if (entry.first->parsed()) {
        return &entry;
      }
    }
    return nullptr;
  }
};

/// A value may start with a minus sign and look like an option: `--direction -.5,0,1`.
std::vector<std::string> joined_directions(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int k = 1; k < argc; ++k) {
    if (!arguments.empty() && arguments.back() == "--direction") {
      arguments.back() += std::string("=") + argv[k];
    } else {
      arguments.emplace_back(argv[k]);
    }
  }
  return arguments;
}

/// `help` and `help solve` are what people try first.
void turn_help_into_option(std::vector<std::string>& arguments) {
  if (arguments.empty() || arguments[0] != "help") {
    return;
  }
  arguments.erase(arguments.begin());
  arguments.resize(std::min<std::size_t>(arguments.size(), 1));
  arguments.emplace_back("--help");
}

/// CLI11 knows that a word was not expected; this says which was meant.
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
                  hint.empty() ? fmt::format("; there are {}", fmt::join(names, ", ")) : hint));
}

std::string unexpected_argument_text(const CLI::App& command) {
  const std::vector<std::string> rest = command.remaining(true);
  if (rest.empty()) {
    return "unexpected argument";
  }
  // Its value may be among the rest too; the option is what is wrong.
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

/// CLI11's errors as one line, with what to type for more.
int report(const Program& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    return program.app.exit(error);  // --help and --version
  }
  const auto* chosen = program.chosen();
  const CLI::App& command = chosen ? *chosen->first : program.app;
  const bool unexpected = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  const std::string text = unexpected ? unexpected_argument_text(command)
                           : !chosen  ? std::string("which command?")
                                      : std::string(error.what());
  print_message(fmt::format("{} (transillum {}--help tells more)", text,
                            chosen ? command.get_name() + " " : std::string()));
  return wrong_call;
}

int run(int argc, char** argv) {
  Program program;
  std::vector<std::string> arguments = joined_directions(argc, argv);
  turn_help_into_option(arguments);
  check_first_word(program, arguments);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    program.app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return report(program, error);
  }
  return program.chosen()->second();
}

int run_reporting_errors(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    print_message(error.what());
    return wrong_call;
  } catch (const NothingToSave& interruption) {
    print_message(std::string("interrupted; ") + interruption.what());
    return interrupted;
  } catch (const Canceled&) {
    print_message("interrupted; there was nothing to save yet");
    return interrupted;
  } catch (const std::exception& error) {
    print_message(error_text(error));
    return failure;
  }
}

/// Results on standard output count as written only now.
int after_flush(int status) {
  errno = 0;
  std::cout.flush();
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  if (written || status != success) {
    return status;
  }
  // A reader that has seen enough, such as `head`, needs no message.
  if (errno != EPIPE) {
    print_message("standard output: cannot be written" +
                  (errno ? ": " + std::generic_category().message(errno) : std::string()));
  }
  return failure;
}

}  // namespace
}  // namespace transillum::cli

int main(int argc, char** argv) {
  using namespace transillum::cli;
  occupy_closed_streams();
  // A closed pipe is an error of writing, not a reason to lose results on their way to files.
  ::signal(SIGPIPE, SIG_IGN);
  return after_flush(run_reporting_errors(argc, argv));
}
