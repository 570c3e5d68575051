// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "transillum/at.h"
#include "transillum/vec3.h"

namespace transillum {

/// A box about its middle.
struct CenteredBox {
  Vec3 center, half;  ///< of its edges

  /// The farthest that the box reaches along `direction`.
  double reach(const Vec3& direction) const {
    return dot(direction, center) + std::abs(direction.x) * half.x +
           std::abs(direction.y) * half.y + std::abs(direction.z) * half.z;
  }
};

/// Finds boxes by where they lie: a binary tree of boxes about boxes.
///
/// Threads: immutable once built.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Bounds>& boxes);

  /// visit(number) for the boxes that `reaches` accepts, as it must every box about them.
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
    std::int32_t first;   ///< node, or the box of a leaf
    std::int32_t second;  ///< node; -1 in a leaf
  };
  struct Item {
    std::int32_t number;
    Bounds box;
  };
  std::int32_t build(std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
};

}  // namespace transillum
