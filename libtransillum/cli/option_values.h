// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "transillum/engine.h"
#include "transillum/scene.h"
#include "transillum/settings.h"

namespace transillum::cli {

// Texts of the command line to values. All throw InputError that names the option, the text and
// what is allowed. `option` is what the message calls it, such as "--threads".

std::int64_t parse_whole_number(const std::string& option, const std::string& text,
                                std::int64_t low, std::int64_t high);
std::uint64_t parse_seed(const std::string& option, const std::string& text);
/// Finite.
double parse_number(const std::string& option, const std::string& text);
/// EngineOptions::resolution
int parse_resolution(const std::string& option, const std::string& text);
/// Bytes: a number with K, M, G or T (powers of 1024) behind it or nothing.
std::uint64_t parse_memory_size(const std::string& option, const std::string& text);

// What the help says of a setting: its sentence of settings.h, and its default.

template <typename Default>
std::string help_of(const std::string& setting, const Default& value) {
  return fmt::format("{} (default {})", description_of(setting), value);
}
/// The same behind the names that it takes.
std::string choice_help(const std::string& setting, const std::vector<std::string>& names,
                        const std::string& default_name);

// Options that several commands share.

void add_scene_argument(CLI::App& command, std::string& scene);
/// --direction, required; a unit vector of it
void add_direction_option(CLI::App& command, Vec3& direction);
/// --engine, --lines, --resolution, --order and --random-lines
void add_engine_options(CLI::App& command, Engine& engine, EngineOptions& options);
/// What they have but --engine.
void add_engine_details(CLI::App& command, EngineOptions& options);
/// --order
void add_order_option(CLI::App& command, EngineOptions& options);
/// --memory and --threads
void add_machine_limits(CLI::App& command, std::uint64_t& memory, int& threads);
/// --two-sided and --max-patch-area
void add_scene_options(CLI::App& command, SceneOptions& options);

/// An option whose text goes through `parse` when it is met, so that the message is ours.
template <typename Parse>
CLI::Option* add_parsed_option(CLI::App& command, const std::string& names, const std::string& type,
                               const std::string& help, Parse parse) {
  return command
      .add_option_function<std::string>(
          names, [parse](const std::string& text) { parse(text); }, help)
      ->type_name(type);
}

}  // namespace transillum::cli
