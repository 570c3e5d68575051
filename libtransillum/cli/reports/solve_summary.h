// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "transillum/solution.h"

namespace transillum::cli {

/// A short table for people.
std::string solve_summary(const Solution& solution);
/// Warnings about a result that is not an error, such as too few directions.
std::vector<std::string> solve_warnings(const Solution& solution);

}  // namespace transillum::cli
