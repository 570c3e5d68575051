// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// F_ij of one patch i to every patch j, without directions or pixels: to compare engines with.
/// Where nothing stands between two patches it is exact; else the smaller of them is taken as many
/// points, from each of which the other is seen exactly (first_shot.h). Sums to 1 in a closed scene
/// but for those points. Takes N pairs; one partly hidden costs as what stands between.
/// `progress`, if given, hears the share done, in [0,1], now and then on the calling thread.
/// @throws Canceled
std::vector<double> exact_form_factors(const Scene& scene, PatchId i,
                                       const Cancellation& cancellation = {},
                                       const std::function<void(double)>& progress = {});

}  // namespace transillum
