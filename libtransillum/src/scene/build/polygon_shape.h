// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <span>
#include <vector>

#include "geometry/convex_partition.h"
#include "transillum/scene.h"

namespace transillum {

/// Measurements of a polygon in space.
struct PolygonShape {
  Vec3 normal;                ///< unit vector by Newell's method; zero if degenerate
  double area = 0;            ///< m²
  Vec3 center;                ///< centroid of the area
  double diameter = 0;        ///< diagonal of the bounding box, m
  double deviation = 0;       ///< distance from the mean plane to the corner farthest from it, m
  double max_coordinate = 0;  ///< largest magnitude, m
  /// No wider than the precision of its coordinates: its area is meaningless.
  bool degenerate = true;
};
PolygonShape measure(std::span<const Vec3> points, std::span<const PointId> outline);

/// Whether an outline without area is a bow tie, whose loops cancel: planar, all corners different
/// and not collinear.
bool is_bow_tie(std::span<const Vec3> points, std::span<const PointId> outline);

/// The corners of an outline, and on both edges the points where two edges cross, on the first of
/// them; nothing where more than `most` edges cross. O(n²).
/// @param plane the corners, projected to the plane of the outline
std::vector<Vec3> with_crossings(std::span<const Vec3> corners, std::span<const PlanePoint> plane,
                                 std::size_t most);

/// Projects an outline to a plane by dropping the axis nearest to the normal: coordinates stay
/// exact, and the result is counter-clockwise.
std::vector<PlanePoint> drop_axis(std::span<const Vec3> points, std::span<const PointId> outline,
                                  const Vec3& normal);

}  // namespace transillum
