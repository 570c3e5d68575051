// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json.hpp>

#include "transillum/run_options.h"

namespace transillum {

/// Options of a solve and of its scene, as in statistics (data/FILES.md). Those that are not
/// chosen, or change nothing, are null.
nlohmann::ordered_json options_json(const RunOptions& run);

}  // namespace transillum
