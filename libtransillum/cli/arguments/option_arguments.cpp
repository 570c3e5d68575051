// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/arguments/option_arguments.h"

#include <fmt/format.h>

#include "transillum/errors.h"

namespace transillum::cli {
namespace {

/// Names the option where a message does not say what it is about.
void set(GivenOptions& options, const Option& option, const std::string& text) {
  try {
    option.parse(options.run, text);
  } catch (const InputError& error) {
    const std::string message = error.what();
    const bool names_it = !option.repeats && message.find('"') != 0;
    throw InputError(names_it ? message : fmt::format("--{}: {}", option.name, message));
  }
  options.given.insert(option.name);
}

CLI::Option* add_flag(CLI::App& command, GivenOptions& options, const Option& option) {
  const bool has_opposite = !option.unset.empty();
  const std::string name = "--" + option.name;
  return command.add_flag_function(
      has_opposite ? name + ",!--no-" + option.name : name,
      [&options, &option](std::int64_t count) { set(options, option, count > 0 ? "yes" : "no"); },
      option.help_text());
}

CLI::Option* add_value(CLI::App& command, GivenOptions& options, const Option& option) {
  const std::string letter = option.letter == 0 ? "" : std::string("-") + option.letter + ",";
  CLI::Option* added = command.add_option_function<std::vector<std::string>>(
      letter + "--" + option.name,
      [&options, &option](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          set(options, option, text);
        }
      },
      option.help_text());
  // Without extra arguments: what follows a value may be the scene.
  added->type_name(option.argument)->expected(1)->allow_extra_args(false);
  if (option.repeats) {
    added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  }
  return added;
}

void add(CLI::App& command, GivenOptions& options, const Option& option) {
  CLI::Option* added =
      option.is_flag() ? add_flag(command, options, option) : add_value(command, options, option);
  if (!option.common) {
    added->group(option.section);
  }
  options.offered.insert(option.name);
}

void exclude_alternatives(CLI::App& command) {
  for (const auto& [one, other] : alternatives()) {
    CLI::Option* first = command.get_option_no_throw(std::string("--") + one);
    CLI::Option* second = command.get_option_no_throw(std::string("--") + other);
    if (first != nullptr && second != nullptr && first->get_excludes().count(second) == 0) {
      first->excludes(second);
    }
  }
}

}  // namespace

void add_options(CLI::App& command, GivenOptions& options,
                 std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    add(command, options, option(std::string(name)));
  }
  exclude_alternatives(command);
}

void add_sections(CLI::App& command, GivenOptions& options,
                  std::initializer_list<std::string_view> sections) {
  for (const std::string_view section : sections) {
    for (const Option& option : transillum::options()) {
      if (option.section == section) {
        add(command, options, option);
      }
    }
  }
  exclude_alternatives(command);
}

void complete(GivenOptions& options) {
  std::set<std::string> given = options.given;
  if (options.offered.count("accuracy") == 0) {
    given.insert("accuracy");
  }
  set_dependent_defaults(options.run, given);
  if (!options.run.refine.is_set() && !options.run.total) {
    options.run.refine = {};
  }
  options.run.validate();
  refuse_unused(options, {options.run});
}

void refuse_unused(const GivenOptions& options, const std::vector<RunOptions>& runs,
                   const std::string& except) {
  for (const std::string& name : options.given) {
    const std::string why = name == except ? std::string() : why_unused(name, runs);
    if (!why.empty()) {
      throw InputError(fmt::format("--{}: {}", name, why));
    }
  }
}

}  // namespace transillum::cli
