// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include "transillum/scene.h"

namespace transillum::viewer {

/// A camera position, meters in scene coordinates.
struct ViewPoint {
  Vec3 eye, target, up;
  double view_angle = 30;  ///< vertical, degrees
  double radius = 1;       ///< radius of the region of interest around `target`, meters

  friend bool operator==(const ViewPoint&, const ViewPoint&) = default;
};

/// The view of a scene after it is opened. Back faces are not drawn, so a closed room is viewed
/// from outside, through its nearest wall.
/// @param aspect  width / height of the picture
ViewPoint initial_view(const Scene& scene, double aspect);

/// A view of the whole scene, with the eye in the direction `toward_eye` from its center.
/// @param view_angle  vertical, degrees
ViewPoint view_of_all(const Scene& scene, const Vec3& toward_eye, const Vec3& up, double view_angle,
                      double aspect);

}  // namespace transillum::viewer
