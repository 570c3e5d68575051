// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include "completions.h"

namespace transillum::manual {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    result += (c == '\'' || c == '\\') ? std::string("\\") + c : std::string(1, c);
  }
  return result + "'";
}

/// A call of fish's list of files by their endings.
std::string files(const std::vector<std::string>& endings) {
  std::string text;
  for (const std::string& ending : endings) {
    text += fmt::format("{}(__fish_complete_suffix {})", text.empty() ? "" : " ", ending);
  }
  return text;
}

std::string value_of(const Program& program, const Option& option) {
  switch (option.proposal) {
    case Proposal::choices:
      return fmt::format(
          " -x -a {}", quoted(option.is_list ? fmt::format("(__fish_complete_list , 'printf "
                                                           "\"%s\\n\" {}')",
                                                           fmt::join(option.choices, " "))
                                             : fmt::format("{}", fmt::join(option.choices, " "))));
    case Proposal::file:
      return option.endings.empty() ? " -r -F"
                                    : fmt::format(" -x -a {}", quoted(files(option.endings)));
    case Proposal::folder:
      return " -x -a '(__fish_complete_directories)'";
    case Proposal::scene:
      return fmt::format(" -x -a {}", quoted(fmt::format("{} {}", fmt::join(scene_names(), " "),
                                                         files(scene_endings(program)))));
    case Proposal::nothing:
      break;
  }
  return " -x";
}

std::string line(const Program& program, const std::string& condition, const Option& option) {
  std::string text = fmt::format("complete -c {}{}", program.name, condition);
  for (const std::string& name : option.names) {
    if (name.starts_with("--")) {
      text += " -l " + name.substr(2);
    } else if (name.starts_with("-")) {
      text += " -s " + name.substr(1);
    }
  }
  if (option.takes_value() && !option.value_is_optional) {
    text += value_of(program, option);
  }
  return text + fmt::format(" -d {}\n", quoted(short_text(option.description)));
}

std::string lines(const Program& program, const Command& command, const std::string& condition) {
  std::string text;
  for (const Option& option : command.options) {
    text += line(program, condition, option);
  }
  if (!command.arguments.empty()) {
    text += fmt::format("complete -c {}{}{}\n", program.name, condition,
                        value_of(program, command.arguments[0]));
  }
  return text;
}

}  // namespace

std::string fish_completion(const Program& program) {
  std::string text =
      fmt::format("# Completion of {0} for fish; generated from its options.\ncomplete -c {0} -f\n",
                  program.name);
  if (program.commands.empty()) {
    return text + lines(program, program.self, "");
  }
  text += lines(program, program.self, " -n __fish_use_subcommand");
  for (const Command& command : program.commands) {
    text += fmt::format("complete -c {} -n __fish_use_subcommand -a {} -d {}\n", program.name,
                        command.name, quoted(command.summary));
  }
  for (const Command& command : program.commands) {
    text +=
        lines(program, command, fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name));
  }
  return text;
}

}  // namespace transillum::manual
