// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "geometry/convex_partition.h"
#include "transillum/scene.h"

namespace transillum {

/// What is measured of a polygon in space.
struct PolygonShape {
  Vec3 normal;           ///< unit, Newell's; zero where there is no area
  double area = 0;       ///< m²
  Vec3 center;           ///< centroid of the area
  double diameter = 0;   ///< diagonal of the bounding box, m
  double deviation = 0;  ///< distance from the mean plane to the corner farthest from it, m
  double max_coordinate = 0;
  /// No wider than its coordinates are precise: what area there is says nothing.
  bool degenerate = true;
};
PolygonShape measure(std::span<const Vec3> points, std::span<const PointId> outline);

/// Whether an outline without area is that of a bow tie, whose loops cancel each other: planar,
/// its corners all different, but not on one line.
bool is_bow_tie(std::span<const Vec3> points, std::span<const PointId> outline);

/// The outline in the plane, by leaving out the axis nearest to the normal: coordinates stay
/// exact, and it turns counter-clockwise.
std::vector<PlanePoint> drop_axis(std::span<const Vec3> points, std::span<const PointId> outline,
                                  const Vec3& normal);

}  // namespace transillum
