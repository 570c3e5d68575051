// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "model/snapshot.h"
#include "radiosity/analysis/result_comparison.h"

namespace transillum::viewer {

/// The difference of run `b` from run `a` of the same patches, by surface of the scene of `a`, with
/// the materials that each has. Time: linear in the corners.
ResultComparison compare_runs(const SolverSnapshot& a, const SolverSnapshot& b);

}  // namespace transillum::viewer
