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
  std::optional<Sampling> sampling;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> rotation;

  /// `sampling`, or the default of two-way or one-way passes.
  Sampling used_sampling(bool two_way = true) const {
    return sampling.value_or(default_sampling(two_way));
  }
};

/// -m, --sampling, --seed, --rotate
void add_sequence_options(CLI::App& command, SequenceOptions& options);

/// Refuses --seed where only the sampling could use it and does not.
/// @throws InputError
void check_seed(const CLI::App& command, const SequenceOptions& options);

}  // namespace transillum::cli
