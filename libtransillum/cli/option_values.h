// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "transillum/engine.h"
#include "transillum/radiosity.h"
#include "transillum/settings.h"

namespace transillum::cli {

// Parsers of option values. All throw InputError with the option's name, the text and the valid
// range. `option` is the name in the message, such as "--threads".

std::int64_t parse_whole_number(const std::string& option, const std::string& text,
                                std::int64_t low, std::int64_t high);
std::optional<double> parse_first_shot(const std::string& option, const std::string& text);
/// accuracy_from_text(), with the option in the error.
double parse_accuracy(const std::string& option, const std::string& text);
/// accuracy_of_from_name(), with the option in the error.
AccuracyGoal parse_accuracy_of(const std::string& option, const std::string& text);
std::uint64_t parse_seed(const std::string& option, const std::string& text);
/// A finite number.
double parse_number(const std::string& option, const std::string& text);
/// X,Y,Z, not all 0, as a unit vector.
Vec3 parse_direction(const std::string& option, const std::string& text);
/// A point, three numbers.
Vec3 parse_point(const std::string& option, const std::string& text);
/// E or E,E,E: an exitance of at least 0 for all channels, or for each.
Rgb parse_exitance(const std::string& option, const std::string& text);
/// EngineOptions::resolution
int parse_resolution(const std::string& option, const std::string& text);
/// EngineOptions::points
int parse_points(const std::string& option, const std::string& text);
/// A number of threads
int parse_thread_count(const std::string& option, const std::string& text);
/// A size in bytes: a number, optionally followed by K, M, G or T (powers of 1024).
std::uint64_t parse_memory_size(const std::string& option, const std::string& text);

// Help text of a setting: its description in settings.h and its default.

template <typename Default>
std::string help_of(const std::string& setting, const Default& value) {
  return fmt::format("{} (default {})", description_of(setting), value);
}
/// The same with the list of valid names.
std::string choice_help(const std::string& setting, const std::vector<std::string>& names,
                        const std::string& default_name);

// Options that would do nothing are refused.

/// Refuses an option that is given but not used.
/// @param option with its dashes; the command need not have it
/// @param why as "used only with engine rays"
/// @throws InputError
void refuse_unless(bool used, const CLI::App& command, const std::string& option,
                   const std::string& why);
/// Refuses every setting that is given but has no effect in any of these solves.
/// @param except a setting that the command uses in another way
/// @throws InputError
void refuse_unused(const CLI::App& command, const std::vector<SolveOptions>& solves,
                   const std::string& except = {});

// Options that several commands share.

/// --direction, required; normalized to a unit vector
void add_direction_option(CLI::App& command, Vec3& direction);
/// --sky, --sky-model and --up
void add_sky_options(CLI::App& command, Sky& sky);
/// --engine, --lines, --resolution, --points, --order and --random-lines
void add_engine_options(CLI::App& command, Engine& engine, EngineOptions& options);
/// The same without --engine.
void add_engine_details(CLI::App& command, EngineOptions& options);
/// --order
void add_order_option(CLI::App& command, EngineOptions& options);
/// --threads
void add_threads_option(CLI::App& command, int& threads);
/// --memory
void add_memory_option(CLI::App& command, std::uint64_t& memory, const std::string& help);
/// --memory and --threads
void add_machine_limits(CLI::App& command, std::uint64_t& memory, int& threads);

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
