// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>

#include "model/snapshot.h"

namespace transillum::viewer {

/// The first hit on a front side for which `shows` holds: others are hidden or clipped.
/// @param begin start of the ray, m; moved past what is not shown
template <class Shows>
std::optional<PickedPoint> first_shown_hit(const LoadedScene& loaded, Vec3& begin,
                                           const Vec3& direction, const Shows& shows) {
  const double past = 2e-5 * loaded.scene->bounds().diagonal();  // beyond what was hit
  auto hit = loaded.picker->first_lit_hit(begin, direction);
  while (hit && !shows(*hit)) {
    begin = hit->point + past * direction;
    hit = loaded.picker->first_lit_hit(begin, direction);
  }
  return hit;
}

}  // namespace transillum::viewer
