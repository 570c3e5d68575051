// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What the user chooses to see.
#pragma once

namespace transillum::viewer {

/// Arrangements of the docks, one per task.
enum class Layout { teach, inspect, debug };
inline constexpr int layout_count = 3;

/// Parts of the 3-D picture that the Show menu switches.
enum class Overlay { normals, back_sides, cuts, shadows, wireframe, smooth };
inline constexpr Overlay all_overlays[] = {Overlay::normals, Overlay::back_sides, Overlay::cuts,
                                           Overlay::shadows, Overlay::wireframe,  Overlay::smooth};

/// A plane across an axis that cuts the picture of a scene open.
struct ClipPlane {
  enum class Axis { x, y, z };
  Axis axis = Axis::x;
  double place = 0.5;       ///< on the axis, in [0, 1] of the scene's extent
  bool other_side = false;  ///< the side before the plane is shown, instead of the side beyond it

  friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

}  // namespace transillum::viewer
