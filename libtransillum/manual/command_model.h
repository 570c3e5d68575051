// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

// Programs, commands and options as manual pages and completions need them. All of it comes from
// the definitions that parse the command line (CLI11) and from the library's lists of names.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace transillum::manual {

/// Proposals of completion for a value.
enum class Proposal { nothing, choices, file, folder, scene };

/// An option or, with a single name that has no dash, an argument.
struct Option {
  std::vector<std::string> names;  ///< typed names: "-m", "--directions"
  std::string type;  ///< type of the value, such as "FILE.csv"; if empty, the option has no value
  bool value_is_optional = false;
  bool required = false;
  bool is_list = false;  ///< the value is a list, separated by commas
  bool repeats = false;  ///< may be given several times
  std::string description;
  Proposal proposal = Proposal::nothing;
  std::vector<std::string> choices;  ///< choices for Proposal::choices
  std::vector<std::string> endings;  ///< endings for Proposal::file, such as ".csv"; if empty, any

  bool takes_value() const { return !type.empty(); }
};

struct Command {
  std::string name;  ///< empty: the program itself
  std::string summary;
  std::string footer;
  std::vector<Option> arguments;
  std::vector<Option> options;
};

struct Program {
  std::string name;
  Command self;                   ///< its options outside of commands
  std::vector<Command> commands;  ///< empty for the viewer
};

/// @param app the definitions of the program called `name`
/// @throws std::runtime_error where an option has a choice of names that is not known here
Program describe(const std::string& name, const CLI::App& app);

}  // namespace transillum::manual
