// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/initial_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace transillum::viewer {

namespace {

// The initial view of each built-in scene.
struct Pose {
  const char* scene;
  Vec3 toward_eye, up;  ///< toward_eye: direction from the target to the eye
  double radius_share;  ///< radius of the region of interest over half the diagonal of the scene
  double view_angle = 30;
};
constexpr Pose poses[] = {
    {"sphere-flake", {0.55, -0.75, 0.38}, {0, 0, 1}, 0.37, 45},
    {"cornell-box", {0, 0, -1}, {0, 1, 0}, 1},
    {"furnace", {0.45, -0.8, 0.45}, {0, 0, 1}, 1},
    {"flatland", {0, -1, 0.12}, {0, 0, 1}, 1},
    {"boards", {0.3, -0.9, 0.5}, {0, 0, 1}, 1},
    {"rooms", {0.35, -0.65, 0.8}, {0, 0, 1}, 1},
    {"gallery", {0.35, -0.65, 0.8}, {0, 0, 1}, 1},
    {"stars", {0.35, -0.9, 0.4}, {0, 0, 1}, 1},
};
// In most OBJ files, y is up.
constexpr Pose file_pose{"", {0.5, 0.45, 0.75}, {0, 1, 0}, 1};

const Pose& pose_of(const Scene& scene) {
  const std::string name = scene.name().substr(0, scene.name().find(':'));
  const auto* found = std::find_if(std::begin(poses), std::end(poses),
                                   [&](const Pose& pose) { return pose.scene == name; });
  return found == std::end(poses) ? file_pose : *found;
}

}  // namespace

ViewPoint view_of_all(const Scene& scene, const Vec3& toward_eye, const Vec3& up, double view_angle,
                      double aspect) {
  ViewPoint view;
  view.up = up;
  view.view_angle = view_angle;
  view.target = scene.bounds().center();
  view.radius = std::max(0.5 * scene.bounds().diagonal(), 1e-9);

  // The least distance at which every point is within the picture.
  const Vec3 back = normalized(toward_eye);
  const Vec3 right = normalized(cross(up, back));
  const Vec3 above = cross(back, right);
  const double tan_vertical = std::tan(view_angle / 2 * std::numbers::pi / 180);
  const double tan_horizontal = tan_vertical * aspect;
  constexpr double margin = 1.06;
  double distance = 0;
  for (const Vec3& p : scene.points()) {
    const Vec3 q = p - view.target;
    const double needed =
        std::max(std::abs(dot(q, right)) / tan_horizontal, std::abs(dot(q, above)) / tan_vertical);
    distance = std::max(distance, dot(q, back) + margin * needed);
  }
  view.eye = view.target + distance * back;
  return view;
}

ViewPoint initial_view(const Scene& scene, double aspect) {
  const Pose& pose = pose_of(scene);
  ViewPoint view = view_of_all(scene, pose.toward_eye, pose.up, pose.view_angle, aspect);
  if (pose.radius_share < 1) {
    // Fit a sphere around the region of interest.
    view.radius *= pose.radius_share;
    const double tangent =
        std::tan(view.view_angle / 2 * std::numbers::pi / 180) * std::min(1.0, aspect);
    view.eye =
        view.target + view.radius / std::sin(std::atan(tangent)) * normalized(pose.toward_eye);
  }
  return view;
}

}  // namespace transillum::viewer
