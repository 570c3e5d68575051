// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "model/snapshot.h"
#include "patches/patch_table.h"

namespace transillum::viewer {

/// Contents of a PatchTable.
struct PatchRows {
  std::vector<PatchId> patches;
  std::vector<PatchColumn> columns;
};

/// Every patch of the scene with all quantities that the snapshot has.
PatchRows rows_of_all(const SolverSnapshot& snapshot);

/// The patches that exchange light with patch i: F_ij and F_ji, the power that i receives from each
/// (A_i F_ij B_j, W), its share of the total, and the power that i sends to each (A_j F_ji B_i, W).
/// Requires the snapshot's form factors.
PatchRows rows_of_partners(const SolverSnapshot& snapshot, PatchId i);

}  // namespace transillum::viewer
