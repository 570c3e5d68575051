// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The cost of the next solve, from what the present one took.
#pragma once

#include <QString>
#include <cstdint>
#include <optional>

#include "model/snapshot.h"

namespace transillum::viewer {

/// The cost of a solve before it begins.
struct SolveCost {
  std::int64_t patches = 0;            ///< patches of the scene to be solved
  std::optional<double> seconds;       ///< s; not set where nothing comparable has been solved
  std::optional<double> most_seconds;  ///< s; at least `seconds`, and set where that is
  std::uint64_t memory = 0;            ///< bytes, without kept form factors
};

/// The cost of solving `wanted`, estimated from the passes of `done`. The passes for an accuracy
/// follow from the error of `done` where that is known. Elsewhere they are between the numbers that
/// built-in scenes need.
/// @param done  null before the first pass: the time is not known then
/// @param patches  number of patches that `wanted` makes
SolveCost cost_of(const SolverSnapshot* done, const SolveOptions& wanted, std::int64_t patches);
/// "2 012 patches, about 3 s, 120 MB".
QString cost_text(const SolveCost& cost);
/// The time alone, in few characters: "3 s", "3–20 s"; empty where it is not known.
QString short_time_text(const SolveCost& cost);

}  // namespace transillum::viewer
