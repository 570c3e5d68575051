// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"

namespace transillum {

/// Finds which fragments may lie above or below a patch along a direction, by bounding spheres.
class PatchShaft {
 public:
  PatchShaft(const Scene& scene, const BspTree& tree, PatchId patch);

  /// Whether the projections of fragment and patch along omega (unit) may overlap; never false if
  /// they do.
  bool may_hold(FragmentId fragment, const Vec3& omega) const {
    const Sphere& sphere = at(spheres_, fragment);
    const Vec3 arm = sphere.center - patch_.center;
    const double along = dot(arm, omega), reach = patch_.radius + sphere.radius;
    return dot(arm, arm) - along * along <= reach * reach;
  }

 private:
  struct Sphere {
    Vec3 center;
    double radius;
  };
  /// Slightly enlarged, so that rounding cannot exclude a point.
  template <class Points>
  static Sphere bounding_sphere(const Points& points);

  Sphere patch_;
  std::vector<Sphere> spheres_;  ///< per fragment
};

}  // namespace transillum
