// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "geometry/form_factor.h"

namespace transillum {

/// Two polygons of which one is sampled: the smaller one, unless it looks much larger from the
/// blockers between them than the other does.
///
/// While a point moves over the sampled polygon, the shadows of blockers move over the other one.
/// Where a blocker is near the sampled polygon, such as a box on a floor below a far lamp, they
/// would pass the whole other polygon from one point to the next.
struct SampledPolygon {
  bool p_is_sampled;
  Outline polygon, other;
  const Vec3& normal;  ///< normal of `polygon`
  double size;         ///< radius of `polygon` over the distance

  /// @param facing outlives it
  /// @param tolerance the least distance that counts
  SampledPolygon(const FacingPolygons& facing, double tolerance,
                 const std::vector<Corners>& blockers = {});

 private:
  struct Places;
  SampledPolygon(const FacingPolygons& facing, const Places& places);
};

}  // namespace transillum
