// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Linear functions on a patch, for piecewise linear radiosity (section 3 of the paper; ALGORITHM.md
// 6.12).
#pragma once

#include <array>
#include <vector>

#include "transillum/export.h"
#include "transillum/scene.h"
#include "transillum/vec3.h"

namespace TRANSILLUM_API transillum {

/// Two functions on a patch that span, with the constant 1, its linear functions, and are
/// orthogonal to it and to each other: with phi_0 = 1, ∫ phi_a phi_b = A if a = b, else 0. phi_1
/// grows along the longest edge of the patch, phi_2 across it.
struct LinearBasis {
  Vec3 center;                   ///< centroid of the patch, m: both functions are 0 there
  std::array<Vec3, 2> gradient;  ///< gradients of phi_1 and phi_2, 1/m, in the plane of the patch

  /// phi_1 and phi_2 at a point of the patch.
  std::array<double, 2> at(const Vec3& point) const {
    const Vec3 offset = point - center;
    return {dot(gradient[0], offset), dot(gradient[1], offset)};
  }
};

/// The linear term of the radiosity of a patch: B(x) = B + first phi_1(x) + second phi_2(x), B
/// being its mean.
struct LinearTerm {
  Rgb first;   ///< coefficient of phi_1, W/m²
  Rgb second;  ///< coefficient of phi_2, W/m²
};

/// The basis of patch i, from the moments of its outline, which may be concave. The patch cut into
/// any pieces has the same.
LinearBasis linear_basis(const Scene& scene, PatchId i);
/// The bases of all patches, by PatchId.
std::vector<LinearBasis> linear_bases(const Scene& scene);

}  // namespace TRANSILLUM_API transillum
