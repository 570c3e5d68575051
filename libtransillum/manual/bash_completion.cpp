// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include "completions.h"

namespace transillum::manual {
namespace {

/// "obj|gltf", for a pattern of bash
std::string glob_of(const std::vector<std::string>& endings) {
  std::string text;
  for (const std::string& ending : endings) {
    text += (text.empty() ? "" : "|") + ending.substr(1);
  }
  return text;
}

/// The commands that propose values of an option; `return` where there is nothing to propose.
std::string proposals(const Option& option) {
  switch (option.proposal) {
    case Proposal::choices:
      return fmt::format("{} '{}'; return", option.is_list ? "@list" : "@words",
                         fmt::join(option.choices, " "));
    case Proposal::file:
      return fmt::format("@files '{}'; return", glob_of(option.endings));
    case Proposal::folder:
      return "@folders; return";
    case Proposal::scene:
      return "@scenes; return";
    case Proposal::nothing:
      break;
  }
  return "return";
}

std::string in_function_names(std::string text, const std::string& function) {
  for (std::size_t at = 0; (at = text.find('@', at)) != std::string::npos;) {
    text.replace(at, 1, function + "_");
  }
  return text;
}

/// A case of the command's name: its options, what their values may be, and its argument.
std::string command_case(const Command& command) {
  std::string words, values;
  for (const Option& option : command.options) {
    words += fmt::format("{}{}", words.empty() ? "" : " ", fmt::join(option.names, " "));
    if (option.takes_value() && !option.value_is_optional) {
      values +=
          fmt::format("        {}) {} ;;\n", fmt::join(option.names, " | "), proposals(option));
    }
  }
  std::string text = fmt::format("    '{}')\n      options='{}'\n", command.name, words);
  if (!values.empty()) {
    text += "      case $option in\n" + values + "      esac\n";
  }
  if (!command.arguments.empty() && command.arguments[0].proposal != Proposal::nothing) {
    std::string argument = proposals(command.arguments[0]);
    argument.resize(argument.find(';'));
    text += fmt::format("      argument=\"{}\"\n", argument);
  }
  return text + "      ;;\n";
}

// The helpers; @ is the program's function.
constexpr const char* helpers = R"sh(
@words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$value"); }

@list() {
  local before=
  [[ $value != *,* ]] || before=${value%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${value##*,}")
  compopt -o nospace
}

# Files whose ending matches a pattern such as "obj|ply", and folders.
@files() {
  local file
  compopt -o filenames
  while IFS= read -r file; do
    [[ -n $1 && ! -d $file && ! $file =~ \.($1)$ ]] || COMPREPLY+=("$file")
  done < <(compgen -f -- "$value")
}

@folders() {
  compopt -o filenames
  mapfile -t COMPREPLY < <(compgen -d -- "$value")
}

)sh";

constexpr const char* beginning =
    R"sh(  local value=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]}
  local options= argument= command=
  COMPREPLY=()
  # Bash splits --option=value into three words.
  if [[ $value == = ]]; then
    value=
  elif [[ $option == = && COMP_CWORD -ge 2 ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  fi
)sh";

constexpr const char* find_command = R"sh(  if ((COMP_CWORD > 1)); then
    command=${COMP_WORDS[1]}
  fi
)sh";

constexpr const char* ending = R"sh(  if [[ $value == -* ]]; then
    @words "$options"
  elif [[ -n $argument ]]; then
    eval "$argument"
  fi
}

)sh";

}  // namespace

std::string bash_completion(const Program& program) {
  const std::string function = function_name(program);
  std::string text =
      fmt::format("# Completion of {} for bash; generated from its options.\n", program.name);
  text += helpers;
  text += fmt::format(
      "@scenes() {{\n  local files names='{}'\n  @files '{}'\n  files=(\"${{COMPREPLY[@]}}\")\n"
      "  @words \"$names\"\n  COMPREPLY+=(\"${{files[@]}}\")\n}}\n\n",
      fmt::join(scene_names(), " "), glob_of(scene_endings(program)));
  text += "@complete() {\n";
  text += beginning;
  std::string cases;
  if (!program.commands.empty()) {
    text += find_command;
    Command self = program.self;
    std::string names;
    for (const Command& command : program.commands) {
      names += (names.empty() ? "" : " ") + command.name;
      cases += command_case(command);
    }
    cases += command_case(self);
    cases.insert(cases.size() - std::string("      ;;\n").size(),
                 fmt::format("      argument=\"@words '{}'\"\n", names));
  } else {
    cases = command_case(program.self);
  }
  text += "  case $command in\n" + cases + "  esac\n";
  text += ending;
  text = in_function_names(text, function);
  // "@" stands for the function; the array below is one of bash's.
  for (std::size_t at = 0; (at = text.find("[" + function + "_]", at)) != std::string::npos;) {
    text.replace(at, function.size() + 3, "[@]");
  }
  return text + fmt::format("complete -F {}_complete {}\n", function, program.name);
}

}  // namespace transillum::manual
