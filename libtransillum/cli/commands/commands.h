// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace transillum::cli {

/// Exit statuses of the program.
enum ExitStatus { success = 0, failure = 1, wrong_call = 2, interrupted = 130 };

/// Runs a command whose options have been parsed; returns the exit status.
using Command = std::function<int()>;

// Each adds a command with its options and help to the program and returns what runs it.
Command add_scene_command(CLI::App& program);
Command add_solve_command(CLI::App& program);
Command add_transfers_command(CLI::App& program);
Command add_map_command(CLI::App& program);
Command add_factors_command(CLI::App& program);
Command add_directions_command(CLI::App& program);
Command add_bounds_command(CLI::App& program);
Command add_study_command(CLI::App& program);
Command add_compare_command(CLI::App& program);
Command add_info_command(CLI::App& program);
Command add_merge_command(CLI::App& program);
Command add_picture_command(CLI::App& program);
Command add_shading_command(CLI::App& program);

}  // namespace transillum::cli
