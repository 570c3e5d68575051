// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {

/// The error of `b` from the spread of replicas.
/// @param replicas B of each, at least two
ErrorEstimate estimate_error(const Scene& scene, const std::vector<Rgb>& b,
                             const std::vector<std::vector<Rgb>>& replicas);

}  // namespace transillum
