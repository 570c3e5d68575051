// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "cli/arguments/option_values.h"

#include <fmt/format.h>

#include "options/option_table.h"
#include "options/option_values.h"
#include "transillum/engine.h"
#include "transillum/errors.h"

namespace transillum::cli {
namespace {

/// Calls `parse`, and puts the name of the option before its error.
template <class Parse>
auto named(const std::string& option, Parse parse) {
  try {
    return parse();
  } catch (const InputError& error) {
    throw InputError(option + ": " + error.what());
  }
}

}  // namespace

std::int64_t parse_whole_number(const std::string& option, const std::string& text,
                                std::int64_t low, std::int64_t high) {
  return named(option, [&] { return whole_number_from_text(text, low, high); });
}

std::optional<double> parse_first_shot(const std::string& option, const std::string& text) {
  RunOptions run;
  named(option, [&] { transillum::option("first-shot").parse(run, text); });
  return run.solve.first_shot;
}

double parse_number(const std::string& option, const std::string& text) {
  return named(option, [&] { return number_from_text(text); });
}

double parse_positive(const std::string& option, const std::string& text, double below) {
  const double value = parse_number(option, text);
  if (!(value > 0 && value < below)) {
    throw InputError(std::isinf(below)
                         ? fmt::format("{}: \"{}\" is not greater than 0", option, text)
                         : fmt::format("{}: \"{}\" is not between 0 and {}", option, text, below));
  }
  return value;
}

std::optional<double> parse_centimeters(const std::string& option, const std::string& text) {
  if (!text.ends_with("cm")) {
    return std::nullopt;
  }
  return parse_positive(option, text.substr(0, text.size() - 2));
}

Vec3 parse_point(const std::string& option, const std::string& text) {
  return named(option, [&] { return point_from_text(text); });
}

int parse_resolution(const std::string& option, const std::string& text) {
  return static_cast<int>(parse_whole_number(option, text, 1, EngineOptions::largest_resolution));
}

int parse_points(const std::string& option, const std::string& text) {
  return static_cast<int>(parse_whole_number(option, text, 1, EngineOptions::largest_points));
}

void refuse_unless(bool used, const CLI::App& command, const std::string& option,
                   const std::string& why) {
  const CLI::Option* known = command.get_option_no_throw(option);
  if (!used && known != nullptr && known->count() > 0) {
    throw InputError(option + ": " + why);
  }
}

void add_figure_options(CLI::App& command, std::optional<std::string>& title, bool& transparent,
                        const std::string& transparent_help) {
  command
      .add_option("--title", title,
                  "title of .png, .svg and .pdf files (default: with the name of the scene in "
                  ".svg and .pdf, none in .png)")
      ->type_name("TITLE");
  command.add_flag("--transparent", transparent, transparent_help);
}

void add_direction_option(CLI::App& command, Vec3& direction) {
  add_parsed_option(command, "--direction", "X,Y,Z",
                    "omega, pointing from the receivers to the sources; any length",
                    [&direction](const std::string& text) {
                      direction = named("--direction", [&] { return direction_from_text(text); });
                    })
      ->required();
}

}  // namespace transillum::cli
