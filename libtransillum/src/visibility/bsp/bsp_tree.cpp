// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/bsp_tree.h"

#include <algorithm>

#include "transillum/at.h"
#include "visibility/bsp/bsp_builder.h"

namespace transillum {

double BspTree::thickness(const Scene& scene) {
  double largest = 0;
  for (const Vec3& p : scene.points()) {
    largest = std::max(largest, max_abs(p));
  }
  return 256 * 0x1p-52 * largest;
}

BspTree::BspTree(const Scene& scene, const Cancellation& cancellation,
                 const std::function<void(double)>& progress, int threads) {
  BspBuilder(scene, *this, cancellation, progress).build(threads);
}

std::vector<FragmentId> BspTree::order(const Vec3& omega, const Cancellation& cancellation) const {
  std::vector<FragmentId> order;
  order.reserve(fragments_.size());

  // A visited node stays on the stack, complemented, until its nearer side is done.
  std::vector<std::int32_t> stack;
  if (root() != no_node) {
    stack.push_back(root());
  }
  for (std::size_t visit = 0; !stack.empty(); ++visit) {
    if (visit % 16384 == 0) {
      cancellation.throw_if_canceled();
    }
    const std::int32_t top = stack.back();
    stack.pop_back();
    const bool returning = top < 0;
    const Node& node = at(nodes_, returning ? ~top : top);
    const bool along = dot(node.plane.normal, omega) >= 0;
    if (!returning) {
      const std::int32_t near = along ? node.front : node.back;
      stack.push_back(~top);
      if (near != no_node) {
        stack.push_back(near);
      }
      continue;
    }
    // In the plane: first the receiving fragments, those that cover others first; then the emitting
    // ones, those that cover others last.
    const FragmentId first = along ? node.begin : node.middle;
    const FragmentId first_end = along ? node.middle : node.end;
    const FragmentId second = along ? node.middle : node.begin;
    const FragmentId second_end = along ? node.end : node.middle;
    for (FragmentId f = first; f < first_end; ++f) {
      order.push_back(f);
    }
    for (FragmentId f = second_end; f-- > second;) {
      order.push_back(f);
    }
    const std::int32_t far = along ? node.back : node.front;
    if (far != no_node) {
      stack.push_back(far);
    }
  }
  return order;
}

}  // namespace transillum
