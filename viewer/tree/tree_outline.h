// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"

namespace transillum::viewer {

/// A node of the BSP tree as a direction passes it. What lies below it is processed in one go:
/// first the side of its plane that omega points to, then what lies in the plane, then the rest.
struct TreeVisit {
  std::int32_t node = BspTree::no_node;
  double cosine = 0;  ///< n·omega, n the plane's normal; where it is negative, the back comes first
  /// Steps of the direction: the near side, the plane's own, the far side.
  std::int32_t begin = 0, plane_begin = 0, plane_end = 0, end = 0;

  enum class Part { near_side, plane, far_side };
  Part part_of(std::int32_t step) const {
    return step < plane_begin ? Part::near_side : step < plane_end ? Part::plane : Part::far_side;
  }
  bool holds(std::int32_t step) const { return begin <= step && step < end; }

  friend bool operator==(const TreeVisit&, const TreeVisit&) = default;
};

/// How many fragments lie below each node, and so where a direction meets them.
class TreeOutline {
 public:
  /// In time linear in the nodes.
  explicit TreeOutline(std::shared_ptr<const BspTree> tree);

  const BspTree& tree() const { return *tree_; }
  const BspTree::Node& node(std::int32_t n) const { return at(tree_->nodes(), n); }
  /// Fragments in and below a node; 0 of no_node.
  std::int32_t size(std::int32_t node) const;
  /// no_node of the root.
  std::int32_t parent(std::int32_t node) const { return at(parents_, node); }
  /// How a direction passes each of the nodes. In time linear in the nodes.
  std::vector<TreeVisit> visits(const Vec3& omega) const;
  /// The sides of a node in the order they come along a direction, without the empty ones.
  std::vector<std::int32_t> children(const TreeVisit& visit) const;
  /// The way from the root to the node whose plane holds the fragment of step `step` in
  /// tree.order(omega); empty where there is no such step. In time linear in its length.
  std::vector<TreeVisit> path_to(std::int32_t step, const Vec3& omega) const;

 private:
  struct Sides {
    std::int32_t near, far;
  };
  TreeVisit visit(std::int32_t node, std::int32_t begin, const Vec3& omega) const;
  Sides sides(const TreeVisit& visit) const;

  std::shared_ptr<const BspTree> tree_;
  std::vector<std::int32_t> sizes_, parents_;  ///< a node
};

}  // namespace transillum::viewer
