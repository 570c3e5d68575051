// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>

#include "patches/patch_columns.h"
#include "radiosity/analysis/power_table.h"

namespace transillum::viewer {

/// A part for the user: its name, or "(no group)".
QString part_text(const PartPower& part);

/// Contents of a PatchTable whose rows are the parts of a power table, by their position.
/// @param received_known  whether there are columns of received light
PatchRows rows_of_parts(const PowerTable& table, bool received_known);

/// The powers that parts exchange: the pairs whose exchange is above rounding. Entry k of the rows
/// is pair number `patches[k]` = receiver * number of parts + sender.
PatchRows rows_of_exchanges(const PowerTable& table);

}  // namespace transillum::viewer
