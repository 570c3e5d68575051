// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <fmt/format.h>

#include "completions.h"

namespace transillum::manual {
namespace {

std::string escaped(const std::string& text, const char* special) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (std::string_view(special).find(c) != std::string_view::npos) {
      result += '\\';
    }
    result += c;
  }
  return result;
}

/// "*.(obj|gltf)(-.)"; without the qualifier, zsh would take "(csv)" for one
std::string qualified_glob_of(const std::vector<std::string>& endings) {
  std::string text;
  for (const std::string& ending : endings) {
    text += (text.empty() ? "" : "|") + ending.substr(1);
  }
  return "*.(" + text + ")(-.)";
}

std::string action(const Option& option, const std::string& function) {
  switch (option.proposal) {
    case Proposal::choices:
      return option.is_list ? fmt::format("_sequence compadd - {}", fmt::join(option.choices, " "))
                            : fmt::format("({})", fmt::join(option.choices, " "));
    case Proposal::file:
      return option.endings.empty()
                 ? "_files"
                 : fmt::format("_files -g \"{}\"", qualified_glob_of(option.endings));
    case Proposal::folder:
      return "_files -/";
    case Proposal::scene:
      return function + "_scenes";
    case Proposal::nothing:
      break;
  }
  return " ";
}

/// The specifications of an option for _arguments.
std::string specification(const Option& option, const std::string& function) {
  const std::string text = escaped(short_text(option.description), "[]\\");
  std::string value;
  if (option.takes_value()) {
    value = fmt::format("{}:{}:{}", option.value_is_optional ? ":" : "",
                        escaped(option.type, ":\\"), action(option, function));
  }
  std::string specifications;
  for (const std::string& name : option.names) {
    const bool joined = option.takes_value() && name.starts_with("--");
    const std::string others =
        option.repeats ? "*" : fmt::format("({})", fmt::join(option.names, " "));
    specifications +=
        fmt::format("    '{}{}{}[{}]{}' \\\n", others, name, joined ? "=" : "", text, value);
  }
  return specifications;
}

std::string specifications(const Command& command, const std::string& function) {
  std::string text;
  for (const Option& option : command.options) {
    text += specification(option, function);
  }
  for (const Option& argument : command.arguments) {
    text += fmt::format("    '{}:{}:{}' \\\n", argument.repeats ? "*" : "",
                        escaped(argument.names[0], ":\\"), action(argument, function));
  }
  return text;
}

std::string function_of(const Command& command, const std::string& function) {
  std::string text = specifications(command, function);
  text.resize(text.size() - 3);  // the last continuation
  return fmt::format("{}_{}() {{\n  _arguments -s \\\n{}\n}}\n\n", function, command.name, text);
}

}  // namespace

std::string zsh_completion(const Program& program) {
  const std::string function = function_name(program);
  std::string text =
      fmt::format("#compdef {}\n# Completion of {} for zsh; generated from its options.\n\n",
                  program.name, program.name);
  text += fmt::format(
      "{0}_scenes() {{\n  _alternative 'built-in:built-in scene:({1})' \\\n"
      "    'file:file:_files -g \"{2}\"'\n}}\n\n",
      function, fmt::join(scene_names(), " "), qualified_glob_of(scene_endings(program)));
  std::string names;
  for (const Command& command : program.commands) {
    text += function_of(command, function);
    names += fmt::format("    '{}:{}'\n", command.name, escaped(command.summary, ":\\"));
  }
  text += function + "() {\n";
  if (program.commands.empty()) {
    std::string all = specifications(program.self, function);
    all.resize(all.size() - 3);
    text += "  _arguments -s \\\n" + all + "\n}\n\n";
  } else {
    text += fmt::format(
        "  local curcontext=\"$curcontext\" state line\n  local -a commands=(\n{}  )\n"
        "  _arguments -C \\\n{}    '1:command:->command' '*::argument:->argument'\n"
        "  case $state in\n    command) _describe command commands ;;\n"
        "    argument)\n      curcontext=\"${{curcontext%:*}}-$words[1]:\"\n"
        "      (( $+functions[{}_$words[1]] )) && {}_$words[1]\n      ;;\n  esac\n}}\n\n",
        names, specifications(program.self, function), function, function);
  }
  return text + function + " \"$@\"\n";
}

}  // namespace transillum::manual
