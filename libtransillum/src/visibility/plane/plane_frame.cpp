// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include <cmath>

#include "transillum/visibility_map.h"

namespace transillum {

PlaneFrame plane_frame(const Scene& scene, const Vec3& omega) {
  // The plane's "up" is z unless omega is nearly parallel to it.
  const Vec3 up = std::abs(omega.z) < 0.95 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  PlaneFrame frame;
  frame.origin = scene.bounds().center();
  frame.omega = omega;
  frame.u = normalized(cross(up, omega));
  frame.v = cross(omega, frame.u);
  return frame;
}

}  // namespace transillum
