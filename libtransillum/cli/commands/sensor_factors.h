// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "cli/arguments/scene_options.h"

namespace transillum::cli {

/// `transillum factors --points`: form factors and irradiance at points.
struct SensorCall {
  std::string points;      ///< file with the sensors; empty: form factors of patches are asked for
  std::string result;      ///< .vtp file with the radiosity
  std::string irradiance;  ///< output file; -: standard output
};

/// --result and --irradiance
void add_sensor_options(CLI::App& command, SensorCall& call);
/// Refuses --result without --irradiance and so on, and options about the form factors of patches.
/// @throws InputError
void check_sensor_options(const CLI::App& command, const SensorCall& call);
/// Computes and writes them; returns the exit status.
/// @param out file for form factors; if empty, none is written where there is a file for the
/// irradiance; else, and for -, standard output
int run_sensors(const SensorCall& call, const SceneInput& scene_input, const std::string& out,
                std::uint64_t memory, int threads);

}  // namespace transillum::cli
