// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Walks through the nodes of a glTF file's scene, which form trees, and places each by its parents.
#include "scene/read/gltf/gltf_nodes.h"

#include <fmt/format.h>

#include <utility>

#include "transillum/at.h"

namespace transillum {
namespace {

Placement placement_of(const tinygltf::Node& node) {
  Placement placement;
  if (node.matrix.size() == 16) {
    placement.axes = {vector_of(node.matrix, 0), vector_of(node.matrix, 4),
                      vector_of(node.matrix, 8)};
    placement.origin = vector_of(node.matrix, 12);
    return placement;
  }
  if (node.rotation.size() == 4) {
    const std::vector<double>& q = node.rotation;
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (length > 0) {
      const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
      placement.axes = {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                        Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                        Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
    }
  }
  if (node.scale.size() == 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      placement.axes[k] = node.scale[k] * placement.axes[k];
    }
  }
  if (node.translation.size() == 3) {
    placement.origin = vector_of(node.translation);
  }
  return placement;
}

/// Root nodes of the scene to be shown first; in a file without scenes, all without a parent.
std::vector<int> root_nodes(const GltfFile& file) {
  const tinygltf::Model& model = file.model();
  if (!model.scenes.empty()) {
    const auto shown = static_cast<std::size_t>(std::max(model.defaultScene, 0));
    if (shown >= model.scenes.size()) {
      file.fail(fmt::format("scene {} does not exist; there are {}", shown, model.scenes.size()));
    }
    return model.scenes[shown].nodes;
  }
  std::vector<char> is_child(model.nodes.size(), 0);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) {
      if (child >= 0 && static_cast<std::size_t>(child) < is_child.size()) {
        at(is_child, child) = 1;
      }
    }
  }
  std::vector<int> roots;
  for (std::size_t n = 0; n < is_child.size(); ++n) {
    if (is_child[n] == 0) {
      roots.push_back(static_cast<int>(n));
    }
  }
  return roots;
}

}  // namespace

std::vector<PlacedNode> placed_nodes(const GltfFile& file) {
  const tinygltf::Model& model = file.model();
  std::vector<PlacedNode> order, open;
  std::vector<char> met(model.nodes.size(), 0);
  const auto meet = [&](int node, const Placement& placement) {
    if (node < 0 || static_cast<std::size_t>(node) >= model.nodes.size()) {
      file.fail(fmt::format("node {} does not exist; there are {}", node, model.nodes.size()));
    }
    if (std::exchange(at(met, node), 1) != 0) {
      file.fail(fmt::format("node {} has two parents or is a child of itself", node));
    }
    open.push_back({node, placement * placement_of(at(model.nodes, node))});
  };
  const std::vector<int> roots = root_nodes(file);
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    meet(*root, {});
  }
  while (!open.empty()) {
    const PlacedNode visit = open.back();
    open.pop_back();
    order.push_back(visit);
    const std::vector<int>& children = at(model.nodes, visit.node).children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      meet(*child, visit.placement);
    }
  }
  return order;
}

}  // namespace transillum
