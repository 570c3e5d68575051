// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/solution.h"

namespace transillum {

/// How much the radiosities of two results differ, as functions on the surfaces.
struct FunctionDifference {
  /// Root of ∫ difference² over the faces where reflected light is measured (reflected_light()),
  /// over the root of ∫ (B - E)² of the reference, of the channel that differs the most; 0 where
  /// nothing differs, infinite where only the reference is dark.
  double l2 = 0;
  double area = 0;  ///< area of all patches, m²
};

/// Compares the radiosity of two results as functions of the point: patches may be finer in one
/// than in the other, and each may be constant or linear on its patches. The integrals are sums
/// over three points of each triangle of the finer result's patches: exact where each of these
/// lies in one patch of the other.
/// @param reference what differences are relative to.
/// @param other a result of the same faces.
/// @throws InputError where the total areas differ, a face of the finer result has no patches in
/// the other, or E or rho of a face differ.
FunctionDifference compare_functions(const Solution& reference, const Solution& other);

}  // namespace transillum
