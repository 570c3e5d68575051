// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Contents of the tables of patches and of parts.
#pragma once

#include <QString>
#include <vector>

#include "model/snapshot.h"
#include "patches/patch_table.h"
#include "radiosity/analysis/power_table.h"
#include "session/error_report.h"

namespace transillum::viewer {

/// Contents of a PatchTable.
struct PatchRows {
  std::vector<PatchId> patches;
  std::vector<PatchColumn> columns;
};

/// Every patch of the scene with all quantities that the snapshot has.
PatchRows rows_of_all(const SolverSnapshot& snapshot);

/// The patches that exchange light with patch i: F_ij and F_ji, the power that i receives from each
/// (A_i F_ij B_j, W), its fraction of the total, and the power that i sends to each (A_j F_ji B_i,
/// W). Requires the snapshot's form factors.
PatchRows rows_of_partners(const SolverSnapshot& snapshot, PatchId i);

/// A part for the user: its name, or "(no group)".
QString surface_text(const SurfacePower& surface);

/// Contents of a PatchTable whose rows are the parts of a power table, by their position.
/// @param received_known  whether there are columns of received light
PatchRows rows_of_parts(const PowerTable& table, bool received_known);

/// The powers that parts exchange: the pairs whose exchange is above rounding. Entry k of the rows
/// is pair number `patches[k]` = receiver * number of parts + sender.
PatchRows rows_of_exchanges(const PowerTable& table);

/// The surfaces of a report, by their position, with their errors by cause and in all.
PatchRows rows_of_errors(const ErrorReport& report);

}  // namespace transillum::viewer
