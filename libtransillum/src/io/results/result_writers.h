// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>

#include "transillum/files.h"
#include "transillum/run_options.h"
#include "transillum/solution.h"

namespace transillum {

// One writer per format of write_result(), besides write_result_csv() of transillum/files.h.
// Doubles are written so that they read back bit for bit. data/FILES.md lists the columns, arrays
// and properties.

/// VTK PolyData with cell arrays face, patch, area, material, E, rho, B, H, with replicas also
/// standard_error, where known F_sum, sky and H_sky, and group; field data: names of the scene, its
/// materials and groups, options and statistics of the solve. read_result() reads it back.
void write_result_vtp(std::ostream& out, const Solution& solution);
/// ASCII PLY, doubles; one polygon per patch with its own corners, colored by B, and its face,
/// patch, area, E, rho, B.
void write_result_ply(std::ostream& out, const Solution& solution, const DisplayOptions& display);
/// Binary glTF 2.0: triangles with COLOR_0, or TEXCOORD_0 and a light map, from B and an unlit
/// material; a node per group.
void write_result_glb(std::ostream& out, const Solution& solution, const DisplayOptions& display);
/// The same as JSON, with the buffer in a data URI.
void write_result_gltf(std::ostream& out, const Solution& solution, const DisplayOptions& display);

/// The exposure of `display`, or the automatic one.
double exposure_of(const Solution& solution, const DisplayOptions& display);

/// Options of a solve and of its scene, as in statistics (data/FILES.md). Those that are not
/// chosen, or change nothing, are null.
nlohmann::ordered_json options_json(const RunOptions& run);

}  // namespace transillum
