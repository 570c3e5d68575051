// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "model/snapshot.h"
#include "transillum/solution.h"

namespace transillum::viewer {

/// The solution that a snapshot shows, with the light of changed materials; its scene has the
/// materials from before the changes. Copies all values: for a worker where there are many patches.
/// @param complete  whether the solve has finished; ignored for a result file, which says so itself
Solution solution_of(const SolverSnapshot& snapshot, bool complete = true);

}  // namespace transillum::viewer
