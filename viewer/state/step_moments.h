// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <map>

#include "transillum/transfers.h"
#include "visibility/map/map_history.h"

namespace transillum::viewer {

/// The moments T^ab of the area that the receiver of a step sees of each patch j with which it
/// exchanges light (ALGORITHM.md 6.12), by j. They are computed from the polygons of the inside
/// list. Empty before the first step, and where the step's patch does not receive.
std::map<PatchId, TransferMoments> moments_of_step(const MapHistory& history, const Scene& scene,
                                                   std::int32_t step);

}  // namespace transillum::viewer
