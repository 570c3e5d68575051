// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "transillum/scene.h"

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

/// Finds pieces of patches by where they lie: a binary tree of boxes.
///
/// Threads: immutable once built.
class PieceTree {
 public:
  explicit PieceTree(const Scene& scene);

  /// visit(piece) for the pieces whose box, and every box about it, `reaches` accepts.
  template <class Reaches, class Visit>
  void for_each(Reaches&& reaches, Visit&& visit) const {
    std::array<std::int32_t, 64> open;
    std::size_t count = 0;
    if (!nodes_.empty()) open[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[static_cast<std::size_t>(open[--count])];
      if (!reaches(node.box)) continue;
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
    std::int32_t first;   ///< node, or piece of a leaf
    std::int32_t second;  ///< node; -1 in a leaf
  };
  struct Item {
    std::int32_t piece;
    Bounds box;
  };
  std::int32_t build(std::vector<Item>& items, std::size_t begin, std::size_t end);

  std::vector<Node> nodes_;
};

}  // namespace transillum
