// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/visibility_map.h"

namespace transillum::viewer {

/// The areas that are drawn over the visibility map to answer a question. Points are in meters on
/// the plane.
struct MapSketch {
  std::vector<Vec2> outline;             ///< corners by the user, in the order clicked
  std::vector<std::vector<Vec2>> right;  ///< the program's region: convex polygons; empty while
                                         ///< hidden
};

/// The same on a patch in the scene. Points are in meters.
struct SceneSketch {
  std::vector<Vec3> outline;
  std::vector<std::vector<Vec3>> right;
};

}  // namespace transillum::viewer
