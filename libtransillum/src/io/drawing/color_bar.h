// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

namespace transillum {

/// The values at which a scale from 0 to `highest` is labeled: all multiples of a round number.
std::vector<double> color_bar_ticks(double highest);

}  // namespace transillum
