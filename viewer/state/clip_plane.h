// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

namespace transillum::viewer {

/// A plane across an axis that cuts the picture of a scene open.
struct ClipPlane {
  enum class Axis { x, y, z };
  Axis axis = Axis::x;
  double place = 0.5;       ///< on the axis, in [0, 1] of the scene's extent
  bool other_side = false;  ///< the side before the plane is shown, instead of the side beyond it

  friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

}  // namespace transillum::viewer
