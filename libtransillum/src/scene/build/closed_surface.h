// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/scene.h"

namespace transillum {

/// Whether every edge is used by as many patches in one direction as in the other. Then the patches
/// form closed surfaces with consistently oriented lit sides: a closed path in space crosses them
/// from the lit side to the back as often as from the back to the lit side.
bool is_closed_surface(const Scene& scene);

}  // namespace transillum
