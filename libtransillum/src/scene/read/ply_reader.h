// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <filesystem>

#include "transillum/scene.h"

namespace transillum {

/// Reads the polygons of a PLY file, ASCII or binary. Colors of faces, else of vertices, are the
/// reflectance: whole numbers of 0 to 255 by the transfer function of sRGB, others as they are.
/// Properties rho_r, rho_g, rho_b and E_r, E_g, E_b of faces, as write_result() writes them, come
/// before colors.
/// @throws InputError naming the file, the line or element, and what is wrong
/// @throws Canceled
SceneDescription read_ply(const std::filesystem::path& path, const ReadOptions& options,
                          const Cancellation& cancellation);

}  // namespace transillum
