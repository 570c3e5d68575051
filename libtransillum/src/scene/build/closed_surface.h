// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/scene.h"

namespace transillum {

/// Whether every edge of a patch is run along by as many patches one way as the other. Then the
/// patches are closed surfaces, each with a lit side: a walk in space that goes through them from
/// lit side to back, say, comes back to where it began through as many from back to lit side.
bool is_closed_surface(const Scene& scene);

}  // namespace transillum
