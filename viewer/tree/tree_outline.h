// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// The BSP tree along one direction: its order, and its nodes in words.
#pragma once

#include <QMetaType>
#include <QString>
#include <cstdint>
#include <memory>
#include <vector>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"

namespace transillum::viewer {

/// A node of the BSP tree along one direction. The fragments in and below it are a run of steps:
/// first the side of its plane that omega points to, then the plane, then the other side.
struct TreeVisit {
  std::int32_t node = BspTree::no_node;
  double cosine = 0;  ///< n·omega, n the plane's normal; if negative, the back comes first
  /// Step numbers: near side [begin, plane_begin), plane [plane_begin, plane_end), far side
  /// [plane_end, end).
  std::int32_t begin = 0, plane_begin = 0, plane_end = 0, end = 0;

  enum class Place { near_side, plane, far_side };
  Place place_of(std::int32_t step) const {
    return step < plane_begin ? Place::near_side
           : step < plane_end ? Place::plane
                              : Place::far_side;
  }
  bool holds(std::int32_t step) const { return begin <= step && step < end; }

  friend bool operator==(const TreeVisit&, const TreeVisit&) = default;
};

/// Number of fragments below each node of a BSP tree, from which the steps of any direction follow.
class TreeOutline {
 public:
  /// Takes time linear in the number of nodes.
  explicit TreeOutline(std::shared_ptr<const BspTree> tree);

  const BspTree& tree() const { return *tree_; }
  const BspTree::Node& node(std::int32_t n) const { return at(tree_->nodes(), n); }
  /// Number of fragments in and below a node; 0 for no_node.
  std::int32_t size(std::int32_t node) const;
  /// no_node for the root.
  std::int32_t parent(std::int32_t node) const { return at(parents_, node); }
  /// One visit per node, along `omega`. Takes time linear in the number of nodes.
  std::vector<TreeVisit> visits(const Vec3& omega) const;
  /// The non-empty sides of a node, in the order along its direction.
  std::vector<std::int32_t> children(const TreeVisit& visit) const;
  /// The path from the root to the node whose plane holds fragment `step` of tree.order(omega);
  /// empty if there is no such step. Takes time linear in its length.
  std::vector<TreeVisit> path_to(std::int32_t step, const Vec3& omega) const;

 private:
  struct Sides {
    std::int32_t near, far;
  };
  TreeVisit visit(std::int32_t node, std::int32_t begin, const Vec3& omega) const;
  Sides sides(const TreeVisit& visit) const;

  std::shared_ptr<const BspTree> tree_;
  std::vector<std::int32_t> sizes_, parents_;  ///< per node
};

/// Role under which the tree's models return a row's TreeVisit.
constexpr int tree_visit_role = Qt::UserRole;

/// A patch in the node's plane; no_patch for a free plane.
PatchId patch_of(const TreeOutline& outline, const TreeVisit& visit);
/// "patch 12 + 3", "free plane".
QString plane_name(const TreeOutline& outline, const TreeVisit& visit);
/// "the plane of patch 12", "a free plane".
QString plane_phrase(const TreeOutline& outline, const TreeVisit& visit);
/// n·omega with its sign.
QString cosine_text(double cosine);
/// The plane's equation, and the order of its sides; three lines, for a tool tip.
QString explanation(const TreeOutline& outline, const TreeVisit& visit);

}  // namespace transillum::viewer

Q_DECLARE_METATYPE(transillum::viewer::TreeVisit)
