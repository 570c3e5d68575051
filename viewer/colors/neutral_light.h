// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "colors/color_map.h"
#include "model/snapshot.h"

namespace transillum::viewer {

/// Brightness, 0.25 to 1, of a white surface with this unit normal in a neutral light that comes
/// from above and the side. For pictures of shapes only; no solve uses it.
double neutral_brightness(const Vec3& normal);
/// The reflectances of all patches in that light, one color per patch; black ones are raised to
/// dark gray.
void shade_neutral(const SolverSnapshot& snapshot, std::vector<Color8>& colors);
/// B in dark grays, for where there are no values, so that the scene remains recognizable.
void shade_gray(const SolverSnapshot& snapshot, std::vector<Color8>& colors);

}  // namespace transillum::viewer
