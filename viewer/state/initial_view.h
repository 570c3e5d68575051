// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/scene.h"

namespace transillum::viewer {

/// Where to look from, and what at.
struct ViewPoint {
  Vec3 eye, target, up;
  double view_angle = 30;  ///< vertical, degrees
  double radius = 1;       ///< of what is worth looking at, round `target`, meters

  friend bool operator==(const ViewPoint&, const ViewPoint&) = default;
};

/// A first look at `scene`, `aspect` = width / height of the picture. Surfaces seen from behind are
/// not drawn, so a closed room is looked into from outside, through its nearest wall.
ViewPoint initial_view(const Scene& scene, double aspect);

/// All of `scene`, with the eye from its middle toward `toward_eye`.
ViewPoint view_of_all(const Scene& scene, const Vec3& toward_eye, const Vec3& up, double view_angle,
                      double aspect);

}  // namespace transillum::viewer
