// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/radiosity.h"

namespace transillum::cli {

/// A short table for people.
std::string solve_summary(const Solution& solution);

}  // namespace transillum::cli
