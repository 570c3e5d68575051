// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>

#include "transillum/directions.h"

namespace transillum::cli {

/// The set of directions, for all commands that use one.
struct SequenceOptions {
  int directions = 1024;
  Sampling sampling = Sampling::fibonacci;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> rotation;
};

/// -m, --sampling, --seed, --rotate
void add_sequence_options(CLI::App& command, SequenceOptions& options);

/// Refuses --seed where only the sampling could use it and does not.
/// @throws InputError
void check_seed(const CLI::App& command, const SequenceOptions& options);

}  // namespace transillum::cli
