// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>

#include "transillum/scene.h"

namespace transillum {

/// Largest magnitude of a coordinate, m; beyond it areas and volumes would overflow.
inline constexpr double largest_coordinate = 1e60;

/// Largest exitance, W/m², and smallest of a scene that has any: beyond them radiosities times
/// areas are out of the range of double.
inline constexpr double largest_exitance = 1e170, smallest_exitance = 1e-170;

/// "name:line: face N: ", the beginning of every message about a face; N counts from 0, as in
/// the results.
std::string face_place(const SceneDescription& description, std::size_t face);

/// Checks 0 <= rho < 1 per channel.
/// @throws InputError beginning with `place`.
void check_reflectance(const Rgb& reflectance, const std::string& place);
/// Checks 0 <= E <= largest_exitance per channel.
/// @throws InputError beginning with `place`.
void check_exitance(const Rgb& exitance, const std::string& place);
/// Largest exponent of a lobe.
inline constexpr double largest_exponent = 1e9;
/// Checks that the share a lobe reflects is finite and at least 0, 0 <= n <= largest_exponent, and
/// that the roughness is in the range 0 to 1.
/// @throws InputError beginning with `place`.
void check_lobe(const Lobe& lobe, const std::string& place);
/// Checks 0 <= rho < 1, 0 <= E <= largest_exitance, and the lobe.
/// @throws InputError beginning with `place`.
void check_material(const Material& material, const std::string& place);

/// Checks all of a description but the shapes of its faces: coordinates, indices, materials.
/// @throws InputError
void check_description(const SceneDescription& description);

}  // namespace transillum
