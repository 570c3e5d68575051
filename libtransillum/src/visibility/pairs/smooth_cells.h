// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "geometry/form_factor.h"

namespace transillum {

/// Cuts `small` along the lines where blockers cross it or stand on it: what it sees differs from
/// one side of them to the other. Then along the lines from which an edge of `large` and a parallel
/// edge of a blocker are in line. There, the form factor to the visible part of `large` has a kink
/// as a function of the point; where other edges and corners are in line, only its second
/// derivative jumps.
/// @param small convex; the cells are convex and make it up.
/// @param tolerance lines that reach no deeper into a cell do not cut it, m.
/// @returns a few dozen cells at most: further lines, and lines of many blockers, cut nothing.
std::vector<Corners> smooth_cells(Outline small, Outline large,
                                  const std::vector<Corners>& blockers, double tolerance);

}  // namespace transillum
