// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/vec3.h"

namespace transillum {

/// The largest degree of move_to_exact_harmonics().
inline constexpr int max_harmonic_degree = 22;

/// Displaces unit vectors smoothly so that the means of all spherical harmonics of the even degrees
/// 2 … `degree` approach 0, their means over the sphere: for the mean m of a harmonic, to O(m²).
/// O(points · degree²).
/// @param degree 0 … max_harmonic_degree.
void move_to_exact_harmonics(std::vector<Vec3>& points, int degree);

}  // namespace transillum
