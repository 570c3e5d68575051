// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "tree_outline.h"

#include <utility>

namespace transillum::viewer {

TreeOutline::TreeOutline(std::shared_ptr<const BspTree> tree)
    : tree_(std::move(tree)), sizes_(tree_->nodes().size()) {
  // Parents come before their children.
  for (std::size_t n = sizes_.size(); n-- > 0;) {
    const BspTree::Node& node = tree_->nodes()[n];
    sizes_[n] = size(node.front) + size(node.back) + (node.end - node.begin);
  }
}

std::int32_t TreeOutline::size(std::int32_t node) const {
  return node == BspTree::no_node ? 0 : sizes_[static_cast<std::size_t>(node)];
}

std::vector<TreeVisit> TreeOutline::path_to(std::int32_t step, const Vec3& omega) const {
  std::vector<TreeVisit> path;
  if (step < 0 || step >= size(tree_->root())) return path;
  std::int32_t begin = 0;
  for (std::int32_t n = tree_->root(); n != BspTree::no_node;) {
    const BspTree::Node& node = this->node(n);
    TreeVisit visit{n, dot(node.plane.normal, omega), begin, 0, 0, begin + size(n)};
    const bool front_first = visit.cosine >= 0;
    const std::int32_t near = front_first ? node.front : node.back;
    const std::int32_t far = front_first ? node.back : node.front;
    visit.plane_begin = begin + size(near);
    visit.plane_end = visit.plane_begin + (node.end - node.begin);
    path.push_back(visit);
    switch (visit.part_of(step)) {
      case TreeVisit::Part::near_side:
        n = near;
        break;
      case TreeVisit::Part::plane:
        return path;
      case TreeVisit::Part::far_side:
        begin = visit.plane_end;
        n = far;
        break;
    }
  }
  return path;
}

}  // namespace transillum::viewer
