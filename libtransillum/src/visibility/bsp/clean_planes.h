// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "transillum/bsp_tree.h"
#include "visibility/bsp/disk_tree.h"
#include "visibility/bsp/polygon_set.h"

namespace transillum {

/// Finds polygons whose planes cut no other polygon of a set. Such a plane is clean: it makes no
/// cut, and no node that the polygon does not need anyway.
class CleanPlanes {
 public:
  /// The plane of a polygon, and what the others of the set are to it.
  struct Plane {
    std::int32_t polygon;
    bool any_front, any_back;  ///< whether polygons are on that side
    std::size_t smaller_side;  ///< number of polygons on the side that has fewer
    std::uint32_t begin, end;  ///< the others in the plane, in in_plane()
    bool one_sided() const { return !any_front || !any_back; }
  };

  /// @param planes of the polygons, by PolygonSet::Polygon::plane; not copied.
  /// @param thickness corners nearer to a plane are on it, m.
  /// @param check called often.
  CleanPlanes(const std::vector<BspTree::Plane>& planes, double thickness,
              std::function<void()> check)
      : planes_(planes), thickness_(thickness), check_(std::move(check)) {}

  /// All clean planes of a small set. O(n²).
  const std::vector<Plane>& find_all(const PolygonSet& set);
  /// Whether a sample of the set's planes has many one-sided ones.
  bool many_one_sided(const PolygonSet& set);
  /// The one-sided clean planes of a set, in an order that keeps neighbors together. O(n log² n)
  /// for round convex sets.
  const std::vector<Plane>& find_one_sided(const PolygonSet& set);
  /// Numbers of polygons that Plane::begin and Plane::end refer to.
  const std::vector<std::int32_t>& in_plane() const { return in_plane_; }

 private:
  void begin(const PolygonSet& set);
  bool is_one_sided_in_sample(std::size_t polygon);
  void test_all(std::int32_t polygon);
  void test_side(const DiskTree& tree, std::int32_t polygon, bool front);
  void test_one_sided(const DiskTree& tree, std::int32_t polygon);
  const BspTree::Plane& plane_of(std::int32_t polygon) const;
  void keep(std::int32_t polygon, std::size_t front, std::size_t back);

  const std::vector<BspTree::Plane>& planes_;
  double thickness_;
  std::function<void()> check_;
  const PolygonSet* set_ = nullptr;
  std::vector<Plane> found_;
  std::vector<std::int32_t> in_plane_;
  std::vector<char> covered_;  ///< whether a polygon is in a plane that was found
  /// Polygons that were on the wrong side before, most likely so again.
  std::array<std::int32_t, 8> witnesses_{};
  std::size_t next_witness_ = 0;
};

}  // namespace transillum
