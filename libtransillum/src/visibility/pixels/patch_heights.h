// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/at.h"
#include "transillum/visibility_map.h"

namespace transillum {

/// Heights of a scene's patches above the points of a transillumination plane, and so the order in
/// which a line along the direction meets them.
class PatchHeights {
 public:
  /// A patch at a sample point of the plane; height in meters above the plane, along omega.
  struct HeightSample {
    PatchId patch;
    double height;
  };

  /// @param snapping largest displacement of corners in the plane, meters
  PatchHeights(const Scene& scene, const PlaneFrame& frame, double snapping = 0);

  /// Whether |n·omega| < 1e-7: such patches are ignored.
  bool edge_on(PatchId i) const { return plane(i).cosine == 0; }
  bool front_facing(PatchId i) const { return plane(i).cosine > 0; }
  double height(PatchId i, const Vec2& at) const {
    const PatchPlane& p = plane(i);
    return p.at_origin + p.along_x * at.x + p.along_y * at.y;
  }
  /// Bound of the rounding error of heights over patch i, meters.
  double slack(PatchId i) const { return plane(i).slack; }
  /// Whether a is treated as above b where they coincide: as in BspTree::order().
  bool comes_first(PatchId a, PatchId b) const;
  /// Sorts from above, each patch once, coincident ones by comes_first(). None may be edge-on.
  void sort(std::vector<HeightSample>& samples) const;
  /// The same of a range, in place. Returns the new end.
  HeightSample* sort(HeightSample* first, HeightSample* last) const;

 private:
  struct PatchPlane {
    double cosine = 0;  ///< n·omega; 0 if edge-on
    double at_origin = 0, along_x = 0, along_y = 0;
    double slack = 0;  ///< bound of a height's rounding error, meters
  };
  const PatchPlane& plane(PatchId i) const { return at(planes_, i); }
  int side_of(PatchId i, PatchId j) const;
  bool above(const HeightSample& a, const HeightSample& b) const;

  const Scene& scene_;
  PlaneFrame frame_;
  double snapping_;
  std::vector<PatchPlane> planes_;
};

}  // namespace transillum
