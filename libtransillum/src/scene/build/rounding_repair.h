// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/cancellation.h"
#include "transillum/scene.h"

namespace transillum {

/// The points of a description, moved within their rounding so that points that lay on a common
/// plane before they were rounded lie on one again: corners of a face, coplanar faces, and what
/// touches them (decisions/0051-undoing-rounding.md). Points that need no move keep their bits.
/// @param rounding of coordinates, m.
/// @throws Canceled
std::vector<Vec3> without_rounding(const SceneDescription& description, double rounding,
                                   const Cancellation& cancellation);

}  // namespace transillum
