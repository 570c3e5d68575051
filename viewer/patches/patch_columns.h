// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "model/snapshot.h"
#include "patches/patch_table.h"

namespace transillum::viewer {

struct PatchRows {
  std::vector<PatchId> patches;
  std::vector<PatchColumn> columns;
};

/// All that a snapshot tells of every patch.
PatchRows rows_of_all(const SolverSnapshot& snapshot);

/// The patches that exchange light with patch i, and how much: F both ways, the power that i
/// receives from each (A_i F_ij B_j, W) and its share of all, and the power that it sends back
/// (A_j F_ji B_i). Wants the snapshot's form factors.
PatchRows rows_of_partners(const SolverSnapshot& snapshot, PatchId i);

}  // namespace transillum::viewer
