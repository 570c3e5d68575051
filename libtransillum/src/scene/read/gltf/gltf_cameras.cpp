// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Cameras of a glTF file's nodes: they look along -z of the node, and +y is up.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/text_file.h"
#include "scene/read/gltf/gltf_nodes.h"
#include "scene/read/scene_cameras.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// The angle and the height of a camera.
void set_lens(const GltfFile& file, const tinygltf::Camera& camera, double scale,
              SceneCamera& made) {
  if (camera.type == "orthographic") {
    made.height = 2 * scale * std::abs(camera.orthographic.ymag);
    if (!(made.height > 0 && std::isfinite(made.height))) {
      file.fail(fmt::format("camera \"{}\": its height ymag is {}, but must be finite and not 0",
                            made.name, camera.orthographic.ymag));
    }
    return;
  }
  const double angle = camera.perspective.yfov;
  if (!(angle > 0 && angle < std::numbers::pi)) {
    file.fail(
        fmt::format("camera \"{}\": its angle yfov is {}, but must be between 0 and pi radians",
                    made.name, angle));
  }
  made.field_of_view = angle * 180 / std::numbers::pi;
}

SceneCamera camera_at(const GltfFile& file, const PlacedNode& placed, double scale) {
  const tinygltf::Model& model = file.model();
  const tinygltf::Node& node = at(model.nodes, placed.node);
  if (static_cast<std::size_t>(node.camera) >= model.cameras.size()) {
    file.fail(fmt::format("node {}: camera {} does not exist; there are {}", placed.node,
                          node.camera, model.cameras.size()));
  }
  const tinygltf::Camera& camera = at(model.cameras, node.camera);
  SceneCamera made;
  made.name = !node.name.empty()     ? node.name
              : !camera.name.empty() ? camera.name
                                     : fmt::format("camera {}", node.camera);
  const Vec3 forward = -placed.placement.axes[2], up = placed.placement.axes[1];
  made.eye = scale * placed.placement.origin;
  if (!(norm(cross(forward, up)) > 0) || !is_finite(forward) || !is_finite(up) ||
      !is_finite(made.eye)) {
    file.fail(fmt::format("camera \"{}\": its node has no direction", made.name));
  }
  made.direction = normalized(forward);
  made.up = normalized(up);
  set_lens(file, camera, scale, made);
  return made;
}

}  // namespace

std::vector<SceneCamera> read_cameras(const std::string& path, double scale,
                                      const Cancellation& cancellation) {
  const std::string ending = lower_case_ending(path);
  if (ending != ".gltf" && ending != ".glb") {
    return {};
  }
  const GltfFile file(path, cancellation);
  std::vector<SceneCamera> cameras;
  for (const PlacedNode& placed : placed_nodes(file)) {
    if (at(file.model().nodes, placed.node).camera >= 0) {
      cameras.push_back(camera_at(file, placed, scale));
    }
  }
  return cameras;
}

}  // namespace transillum
