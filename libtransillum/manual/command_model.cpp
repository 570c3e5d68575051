// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "command_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <stdexcept>

#include "io/drawing/study_chart.h"
#include "options/option_table.h"
#include "radiosity/analysis/power_table.h"
#include "transillum/engine.h"
#include "transillum/files.h"
#include "transillum/study.h"
#include "visibility/pixels/pixel_map.h"

namespace transillum::manual {
namespace {

using Names = std::vector<std::string>;

/// The engines that a command accepts.
Names engines_of(const std::string& command) {
  Names names = names_of<Engine>();
  std::erase_if(names, [&](const std::string& name) {
    const Engine engine = from_name<Engine>(name);
    return (command == "map" && engine != Engine::local && !has_pixels(engine)) ||
           (command == "transfers" && !takes_directions(engine));
  });
  return names;
}

/// The names that an option accepts; empty if it has no fixed names.
Names choices_of(const std::string& command, const std::string& option) {
  static const std::map<std::string, Names> of_commands{
      {"by", names_of<SurfaceKind>()},
      {"error", names_of<ErrorMeasure>()},
      {"tone", names_of<ToneCurve>()},
      {"against", names_of<StudyAxis>()},
      {"series-every", {"iteration", "direction"}},
  };
  if (option == "engine" || option == "engines") {
    return engines_of(command);
  }
  if (const auto found = of_commands.find(option); found != of_commands.end()) {
    return found->second;
  }
  const auto& all = transillum::options();
  const auto known = std::find_if(all.begin(), all.end(),
                                  [&](const transillum::Option& o) { return o.name == option; });
  Names names = known == all.end() || known->is_flag() ? Names() : known->choices;
  std::erase_if(names, [](const std::string& name) { return name.find(':') != std::string::npos; });
  return names;
}

/// CLI11's names of types, in the notation of our help; what follows a colon are its checks.
std::string type_of(const CLI::Option& option) {
  std::string type = option.get_type_name();
  static const std::map<std::string, std::string> ours{
      {"INT", "N"}, {"UINT", "N"}, {"FLOAT", "X"}, {"TEXT", "NAME"}};
  const auto found = ours.find(type.substr(0, type.find_first_of(": ")));
  return found == ours.end() ? type : found->second;
}

/// ".csv" of "FILE.csv"
Names endings_in(const std::string& type) {
  Names endings;
  static const std::regex ending(R"(\.[a-z]+\b)");
  for (std::sregex_iterator m(type.begin(), type.end(), ending), end; m != end; ++m) {
    endings.push_back(m->str());
  }
  return endings;
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

void set_proposal(const std::string& command, const std::string& long_name, Option& option) {
  option.choices = choices_of(command, long_name);
  option.endings = endings_in(option.type);
  if (!option.choices.empty()) {
    option.proposal = Proposal::choices;
    option.endings.clear();
  } else if (option.type == "SCENE") {
    option.proposal = Proposal::scene;
  } else if (option.type == "FOLDER") {
    option.proposal = Proposal::folder;
  } else if (contains(option.type, "FILE") || !option.endings.empty()) {
    option.proposal = Proposal::file;
  } else if (option.type.starts_with("NAME") && !contains(option.type, "=")) {
    throw std::runtime_error(
        fmt::format("{} --{}: completion does not know its names", command, long_name));
  }
}

std::string description_of_option(const CLI::Option& option) {
  std::string text = option.get_description();
  if (const std::string value = option.get_default_str(); !value.empty()) {
    text += fmt::format(" (default {})", value);
  }
  return text;
}

Option describe_option(const std::string& command, const CLI::Option& source) {
  Option option;
  for (const std::string& name : source.get_snames()) {
    option.names.push_back("-" + name);
  }
  for (const std::string& name : source.get_lnames()) {
    option.names.push_back("--" + name);
  }
  const bool is_argument = option.names.empty();
  if (is_argument) {
    option.names.push_back(source.get_name(true));
  }
  option.description = description_of_option(source);
  option.required = source.get_required();
  option.repeats = source.get_items_expected_max() > 1 ||
                   source.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  if (is_argument || source.get_items_expected_max() > 0) {
    option.type = is_argument && contains(option.names[0], "SCENE") ? "SCENE" : type_of(source);
    option.value_is_optional = option.type.starts_with("[");
    option.is_list = option.type.ends_with(",...");
    for (const std::string& name : source.get_lnames()) {
      set_proposal(command, name, option);
    }
    if (is_argument) {
      set_proposal(command, option.names[0], option);
    }
  }
  return option;
}

Command describe_command(const CLI::App& app, const std::string& name) {
  Command command;
  command.name = name;
  command.summary = app.get_description();
  command.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    auto& list = option->get_positional() ? command.arguments : command.options;
    list.push_back(describe_option(name, *option));
  }
  return command;
}

}  // namespace

Program describe(const std::string& name, const CLI::App& app) {
  Program program;
  program.name = name;
  program.self = describe_command(app, "");
  const auto any = [](const CLI::App*) { return true; };
  for (const CLI::App* command : app.get_subcommands(any)) {
    program.commands.push_back(describe_command(*command, command->get_name()));
  }
  return program;
}

}  // namespace transillum::manual
