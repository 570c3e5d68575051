// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "transillum/vec3.h"

namespace transillum::cli {

// Parsers of the values of options that are not in the library's table. All throw InputError with
// the option's name, the text and the valid range. `option` is the name in the message, such as
// "--threads".

std::int64_t parse_whole_number(const std::string& option, const std::string& text,
                                std::int64_t low, std::int64_t high);
std::optional<double> parse_first_shot(const std::string& option, const std::string& text);
/// A finite number.
double parse_number(const std::string& option, const std::string& text);
/// A number greater than 0 and less than `below`.
double parse_positive(const std::string& option, const std::string& text, double below = HUGE_VAL);
/// Pixels per inch where the size of a picture is given in centimeters.
inline constexpr double printed_pixels_per_inch = 300;
/// The number before "cm" at the end, greater than 0; none without "cm".
std::optional<double> parse_centimeters(const std::string& option, const std::string& text);
/// --title and --transparent of pictures and maps.
/// @param transparent_help  says what is not drawn
void add_figure_options(CLI::App& command, std::optional<std::string>& title, bool& transparent,
                        const std::string& transparent_help);
/// A point, three numbers.
Vec3 parse_point(const std::string& option, const std::string& text);
/// EngineOptions::resolution
int parse_resolution(const std::string& option, const std::string& text);
/// EngineOptions::points
int parse_points(const std::string& option, const std::string& text);

/// Refuses an option that is given but not used.
/// @param option with its dashes; the command need not have it
/// @param why as "used only with engine rays"
/// @throws InputError
void refuse_unless(bool used, const CLI::App& command, const std::string& option,
                   const std::string& why);

/// --direction, required; normalized to a unit vector
void add_direction_option(CLI::App& command, Vec3& direction);

/// An option whose value is parsed by `parse`, which gives the error message.
template <typename Parse>
CLI::Option* add_parsed_option(CLI::App& command, const std::string& names, const std::string& type,
                               const std::string& help, Parse parse) {
  return command
      .add_option_function<std::string>(
          names, [parse](const std::string& text) { parse(text); }, help)
      ->type_name(type);
}

}  // namespace transillum::cli
