// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "transillum/files.h"
#include "transillum/solve_options.h"

namespace transillum::cli {

/// Results for programs that show them.
struct ColorOutputs {
  DisplayOptions display;
  std::optional<Vec3> target;  ///< --target
  bool sharp = false;          ///< --sharp
  double texels = 0;           ///< --texels, per meter; 0 means the default of LightMap
  std::string series;          ///< --series
  int series_every = 0;        ///< --series-every: a number of directions; 0 means every iteration
};

/// --exposure, --target, --light-map, --sharp, --texels, --series, --series-every
void add_color_outputs(CLI::App& command, ColorOutputs& colors);
/// Takes --up, which the sky has, for the display too.
void set_up_of_display(const CLI::App& command, const Sky& sky, ColorOutputs& colors);
/// Refuses these options and --up where no output or solve uses them.
/// @throws InputError
void check_color_outputs(const CLI::App& command, const ColorOutputs& colors,
                         const std::vector<std::string>& out, const SolveOptions& options);
/// Refuses a series that would write one of these files.
/// @throws InputError
void check_series(const ColorOutputs& colors, const std::vector<std::string>& files);
}  // namespace transillum::cli
