// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>
#include <vector>

#include "transillum/cancellation.h"
#include "transillum/export.h"
#include "transillum/scene.h"

namespace TRANSILLUM_API transillum {

/// F_ij of one patch i to every patch j, without directions or pixels: a reference for engines.
///
/// Exact where nothing stands between two patches. Otherwise the smaller of them is sampled at many
/// points, from each of which the other's visible part is computed exactly (first_shot.h). In a
/// closed scene the sum is 1 up to that sampling. Takes one computation per patch j; its cost for a
/// partly hidden pair grows with the number of polygons between them.
/// @param scene the scene.
/// @param i the patch.
/// @param cancellation checked during computation.
/// @param progress if set, called at intervals with the share done, in [0,1], on this thread.
/// @throws Canceled
std::vector<double> exact_form_factors(const Scene& scene, PatchId i,
                                       const Cancellation& cancellation = {},
                                       const std::function<void(double)>& progress = {});

}  // namespace TRANSILLUM_API transillum
