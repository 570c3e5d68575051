// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iosfwd>

#include "transillum/radiosity.h"

namespace transillum {

// One writer a format of write_result(). Doubles are written so that they read back bit for bit.

/// face,patch,area,E_r,E_g,E_b,rho_r,rho_g,rho_b,B_r,B_g,B_b
void write_result_csv(std::ostream& out, const Solution& solution);
/// VTK PolyData with cell arrays face, patch, area, material, E, rho, B, H and, as field data, the
/// scene's name, that of its materials and what is known of the solve: what read_result() needs.
void write_result_vtp(std::ostream& out, const Solution& solution);
/// ASCII, doubles; a polygon a patch with its face, patch, area, E, rho, B.
void write_result_ply(std::ostream& out, const Solution& solution);
/// A polygon a patch with corners of its own, whose color is the patch's B, linear, unscaled.
void write_result_obj(std::ostream& out, const Solution& solution);

}  // namespace transillum
