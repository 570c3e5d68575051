// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "transillum/vec3.h"

namespace transillum {

/// An axis-parallel box by its center.
struct CenteredBox {
  Vec3 center;  ///< m
  Vec3 half;    ///< half the lengths of the edges, m

  /// Largest dot(direction, p) over the points p of the box.
  double reach(const Vec3& direction) const {
    return dot(direction, center) + std::abs(direction.x) * half.x +
           std::abs(direction.y) * half.y + std::abs(direction.z) * half.z;
  }
};

/// Bounding volume hierarchy: finds the boxes that meet a condition.
///
/// Threads: immutable once built.
class BoxTree {
 public:
  /// O(n log² n). Boxes are numbered by their order in `boxes`.
  explicit BoxTree(const std::vector<Bounds>& boxes);

  /// Calls visit(number) for every box that `reaches` accepts. `reaches` must accept every box that
  /// contains an accepted one.
  template <class Reaches, class Visit>
  void for_each(Reaches&& reaches, Visit&& visit) const {
    std::array<std::int32_t, 64> open;
    std::size_t count = 0;
    if (!nodes_.empty()) {
      open[count++] = 0;
    }
    while (count > 0) {
      const Node& node = at(nodes_, open[--count]);
      if (!reaches(node.box)) {
        continue;
      }
      if (node.second < 0) {
        visit(node.first);
      } else {
        open[count++] = node.second;
        open[count++] = node.first;
      }
    }
  }

 private:
  struct Node {
    CenteredBox box;
    std::int32_t first;   ///< first child; in a leaf the number of the box
    std::int32_t second;  ///< second child; -1 in a leaf
  };
  struct Item {
    std::int32_t number;
    Bounds box;
  };
  std::int32_t build(std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
};

}  // namespace transillum
