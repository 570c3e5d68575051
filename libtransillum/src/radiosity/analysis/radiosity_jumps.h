// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/refinement.h"

namespace transillum {

/// The squares of radiosity_jumps() by channel, (W/m²)², one per patch.
std::vector<Rgb> squared_jumps(const Solution& solution, const Cancellation& cancellation);

}  // namespace transillum
