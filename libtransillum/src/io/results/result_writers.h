// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iosfwd>

#include "transillum/radiosity.h"

namespace transillum {

// One writer per format of write_result(), besides write_result_csv() of transillum/files.h.
// Doubles are written so that they read back bit for bit. data/FILES.md lists the columns, arrays
// and properties.

/// VTK PolyData with cell arrays face, patch, area, material, E, rho, B, H, with replicas also
/// standard_error; field data: names of the scene and its materials, options and statistics of the
/// solve. read_result() reads it back.
void write_result_vtp(std::ostream& out, const Solution& solution);
/// ASCII PLY, doubles; one polygon per patch with its face, patch, area, E, rho, B.
void write_result_ply(std::ostream& out, const Solution& solution);
/// One polygon per patch with its own corners, whose color is the patch's B, linear, unscaled.
void write_result_obj(std::ostream& out, const Solution& solution);

}  // namespace transillum
