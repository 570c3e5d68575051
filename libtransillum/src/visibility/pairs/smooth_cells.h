// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "geometry/form_factor.h"

namespace transillum {

/// Cuts `small` along the lines where the visible part of `large` changes its shape: where a corner
/// of one of `large` and a blocker crosses an edge of the other, as seen from the point. Within a
/// cell, the form factor to the visible part is a smooth function of the point, except where edges
/// of two blockers and of `large` meet in one line of sight.
/// @param small convex; the cells are convex and make it up.
/// @param tolerance lines that reach no deeper into a cell do not cut it, m.
/// @returns `small` alone if more than a few lines cut it: then many points of a cell would cost
/// more than they gain.
std::vector<Corners> smooth_cells(Outline small, Outline large,
                                  const std::vector<Corners>& blockers, double tolerance);

}  // namespace transillum
