// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/scene.h"

namespace transillum {

/// Coordinates beyond this would overflow in areas and volumes.
inline constexpr double largest_coordinate = 1e60;

/// "name:line: face N: ", the beginning of every sentence about a face; N counts from 0, as in
/// the results.
std::string face_place(const SceneDescription& description, std::size_t face);

/// @throws InputError beginning with `place` unless 0 <= rho < 1 and 0 <= E < infinity.
void check_material(const Material& material, const std::string& place);

/// Whatever can be wrong before the shape of faces is looked at.
/// @throws InputError
void check_description(const SceneDescription& description);

}  // namespace transillum
