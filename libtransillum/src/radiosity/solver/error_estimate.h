// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {

/// How far `b` may be off, given the radiosity that each of at least two replicas makes of it.
ErrorEstimate estimate_error(const Scene& scene, const std::vector<Rgb>& b,
                             const std::vector<std::vector<Rgb>>& replicas);

}  // namespace transillum
