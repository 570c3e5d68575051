// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cmath>
#include <vector>

#include "transillum/at.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// How high the patches of a scene lie above the points of a transillumination plane, and so in
/// which order a line along the direction meets them.
class PatchHeights {
 public:
  /// A patch on a line, meters above the plane along omega.
  struct Hit {
    PatchId patch;
    double height;
  };

  /// `snapping`: by so many meters corners may have been moved in the plane.
  PatchHeights(const Scene& scene, const PlaneFrame& frame, double snapping = 0);

  /// Seen at a cosine of less than 1e-7, it takes no part.
  bool edge_on(PatchId i) const { return plane(i).cosine == 0; }
  bool front_facing(PatchId i) const { return plane(i).cosine > 0; }
  double height(PatchId i, const Vec2& at) const {
    const PatchPlane& p = plane(i);
    return p.at_origin + p.along_x * at.x + p.along_y * at.y;
  }
  /// What rounding may do to heights over patch i, meters.
  double slack(PatchId i) const { return plane(i).slack; }
  /// Whether a comes before b, from above, where they coincide: as in BspTree::order().
  bool comes_first(PatchId a, PatchId b) const;
  /// From above, each patch once; coincident ones by comes_first(). None is edge-on.
  void sort(std::vector<Hit>& hits) const;
  /// The same, in place; returns the new end.
  Hit* sort(Hit* first, Hit* last) const;

 private:
  struct PatchPlane {
    double cosine = 0;  ///< n·omega; 0: edge-on
    double at_origin = 0, along_x = 0, along_y = 0;
    double slack = 0;  ///< what rounding may do to a height
  };
  const PatchPlane& plane(PatchId i) const { return at(planes_, i); }
  int side_of(PatchId i, PatchId j) const;
  bool above(const Hit& a, const Hit& b) const;

  const Scene& scene_;
  PlaneFrame frame_;
  double snapping_;
  std::vector<PatchPlane> planes_;
};

}  // namespace transillum
