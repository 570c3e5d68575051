// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "transillum/bsp_tree.h"

namespace transillum {

/// Convex polygons in one part of space, not yet in the tree. Holds the places of their corners, so
/// that sets are independent of each other: threads share nothing that grows.
struct PolygonSet {
  /// A piece, or a part of one.
  struct Polygon {
    PatchId patch;
    std::int32_t plane;   ///< index of its plane
    std::uint32_t begin;  ///< first index in corners and places
    std::uint32_t end;    ///< one past the last
  };
  /// Signed distances from a plane, m.
  struct Extent {
    double low, high;
  };

  std::vector<Polygon> polygons;
  std::vector<BspTree::Corner> corners;
  std::vector<Vec3> places;  ///< positions of the corners, m

  std::size_t size() const { return polygons.size(); }
  void add(const PolygonSet& from, const Polygon& polygon) {
    const auto begin = static_cast<std::uint32_t>(corners.size());
    corners.insert(corners.end(), from.corners.begin() + polygon.begin,
                   from.corners.begin() + polygon.end);
    places.insert(places.end(), from.places.begin() + polygon.begin,
                  from.places.begin() + polygon.end);
    polygons.push_back(
        {polygon.patch, polygon.plane, begin, static_cast<std::uint32_t>(corners.size())});
  }
  /// Smallest and largest distance of a polygon's corners from a plane.
  Extent extent(const Polygon& polygon, const BspTree::Plane& plane) const {
    Extent extent{HUGE_VAL, -HUGE_VAL};
    for (std::uint32_t c = polygon.begin; c < polygon.end; ++c) {
      const double distance = dot(plane.normal, places[c]) - plane.offset;
      extent.low = std::min(extent.low, distance);
      extent.high = std::max(extent.high, distance);
    }
    return extent;
  }
};

}  // namespace transillum
