// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"

namespace transillum {

/// Which fragments may lie above or below a patch, whatever the direction: by spheres about them.
class PatchShaft {
 public:
  PatchShaft(const Scene& scene, const BspTree& tree, PatchId patch);

  /// Whether their projections along omega (unit) may meet; never wrong where it says no.
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
  /// A little larger than need be, for what rounding does.
  template <class Points>
  static Sphere about(const Points& points);

  Sphere patch_;
  std::vector<Sphere> spheres_;  ///< a fragment
};

}  // namespace transillum
