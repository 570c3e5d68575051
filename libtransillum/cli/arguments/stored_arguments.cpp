// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <set>

#include "cli/arguments/solve_call.h"

namespace transillum::cli {
namespace {

/// Appends an option as it can be parsed again. Values follow a =, since one such as -.5,0,1 would
/// be taken for an option.
void append(std::vector<std::string>& arguments, const CLI::Option& option) {
  if (option.get_expected_max() == 0) {  // a flag
    arguments.push_back(option.get_name());
    return;
  }
  for (const std::string& value : option.results()) {
    arguments.push_back(option.get_positional() ? value : option.get_name() + "=" + value);
  }
}

/// The names of the options that only say what is written and on which machine.
std::set<std::string> names_of_outputs() {
  CLI::App app;
  SolveCall call;
  add_output_options(app, call);
  std::set<std::string> names = {"--checkpoint", "--checkpoint-every", "--resume", "--shard"};
  for (const CLI::Option* option : app.get_options()) {
    names.insert(option->get_name());
  }
  return names;
}

}  // namespace

std::vector<std::string> stored_arguments(const CLI::App& command) {
  const std::set<std::string> outputs = names_of_outputs();
  std::vector<std::string> arguments;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0 && !outputs.contains(option->get_name())) {
      append(arguments, *option);
    }
  }
  return arguments;
}

std::vector<std::string> given_options(const CLI::App& command) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() > 0 && !option->get_positional()) {
      append(arguments, *option);
    }
  }
  return arguments;
}

}  // namespace transillum::cli
