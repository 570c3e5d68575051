// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "visibility/bsp/polygon_set.h"

namespace transillum {

/// Bounding volume hierarchy of polygons: finds those that reach a plane. Its volumes are cylinders
/// along the mean normal, flat where a surface is nearly flat: a plane that touches a round surface
/// meets few of them, where it would meet the corners of many boxes.
class DiskTree {
 public:
  /// O(n log² n).
  /// @param set not copied.
  /// @param planes of the polygons, by PolygonSet::Polygon::plane.
  /// @param check called often.
  DiskTree(const PolygonSet& set, const std::vector<BspTree::Plane>& planes,
           const std::function<void()>& check);

  /// The polygons, neighbors together.
  const std::vector<std::int32_t>& polygons() const { return polygons_; }

  /// Calls visit(polygon) for those that may have points at or in front of the plane at `offset`
  /// along `normal`, until it returns false.
  template <class Visit>
  void for_each_reaching(const Vec3& normal, double offset, Visit&& visit) const {
    std::array<std::uint32_t, 64> open;
    std::size_t count = 0;
    open[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[open[--count]];
      if (node.reach(normal) < offset) {
        continue;
      }
      if (node.second > 0) {
        open[count++] = node.second;
        open[count++] = node.first;
        continue;
      }
      for (std::uint32_t k = node.begin; k < node.end; ++k) {
        if (!visit(polygons_[k])) {
          return;
        }
      }
    }
  }

 private:
  struct Node {
    Vec3 center, axis;
    double half_height, radius;           ///< m
    std::uint32_t begin, end;             ///< in polygons_
    std::uint32_t first = 0, second = 0;  ///< children; 0 in a leaf

    double reach(const Vec3& normal) const {
      const double along = dot(normal, axis);
      return dot(normal, center) + std::abs(along) * half_height +
             std::sqrt(std::max(0.0, 1 - along * along)) * radius;
    }
  };
  Node bound(std::uint32_t begin, std::uint32_t end) const;
  std::size_t halve(std::uint32_t begin, std::uint32_t end);

  const PolygonSet& set_;
  const std::vector<BspTree::Plane>& planes_;
  std::vector<Vec3> centers_;
  std::vector<std::int32_t> polygons_;
  std::vector<Node> nodes_;
};

}  // namespace transillum
