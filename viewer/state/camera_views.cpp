// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Camera positions computed from the scene's bounds or from a patch, and the user's bookmarks.
#include "state/camera_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/list_change.h"

namespace transillum::viewer {

namespace {

// The initial view of each built-in scene.
struct Pose {
  const char* scene;
  Vec3 toward_eye, up;     ///< toward_eye: direction from the target to the eye
  double radius_fraction;  ///< radius of the region of interest over half the diagonal of the scene
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

constexpr NamedAxis all_named_axes[] = {{"+z", {0, 0, 1}},  {"+y", {0, 1, 0}},  {"+x", {1, 0, 0}},
                                        {"−z", {0, 0, -1}}, {"−y", {0, -1, 0}}, {"−x", {-1, 0, 0}}};

/// The direction that the front of a scene faces: if z is up, the front view is along +y, as in a
/// plan; if y is up, along -z, as on a screen.
Vec3 front_of(const Vec3& up) { return std::abs(up.z) > 0.5 ? Vec3{0, -1, 0} : Vec3{0, 0, 1}; }

/// The pose of a file with another vertical.
Pose upright_pose(const Vec3& up) {
  Pose pose = file_pose;
  const Vec3 front = normalized(front_of(up) - dot(front_of(up), up) * up);
  pose.toward_eye = file_pose.toward_eye.x * cross(up, front) + file_pose.toward_eye.y * up +
                    file_pose.toward_eye.z * front;
  pose.up = up;
  return pose;
}

/// The area of the fronts that face a direction, projected along it, m².
double fronts_toward(const Scene& scene, const Vec3& direction) {
  double area = 0;
  for (const Patch& patch : scene.patches()) {
    area += patch.area * std::max(0.0, dot(patch.normal, direction));
  }
  return area;
}

/// Turns a pose to where the scene shows its fronts, if it shows less than half of them: a single
/// wall, or a room whose front side is open. Closed surfaces show as much from everywhere.
Pose turned_to_fronts(const Scene& scene, const Pose& pose) {
  const Vec3 above = dot(pose.toward_eye, pose.up) * pose.up;
  const Vec3 aside = pose.toward_eye - above, across = cross(pose.up, aside);
  const double first = fronts_toward(scene, normalized(pose.toward_eye));
  double most = 2 * first;
  Pose result = pose;
  for (const double height : {1.0, -1.0}) {
    for (const Vec3& toward : {aside, across, -across, -aside}) {
      const Vec3 toward_eye = toward + height * above;
      if (const double area = fronts_toward(scene, normalized(toward_eye)); area > most) {
        most = area;
        result.toward_eye = toward_eye;
      }
    }
  }
  return result;
}

}  // namespace

std::span<const NamedAxis> named_axes() { return all_named_axes; }

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

ViewPoint initial_view(const Scene& scene, double aspect, const std::optional<Vec3>& up) {
  const std::string name = scene.name().substr(0, scene.name().find(':'));
  const Pose* const known = std::ranges::find(poses, name, &Pose::scene);
  Pose pose = known == std::end(poses) ? file_pose : *known;
  if (up && !(*up == pose.up)) {
    pose = upright_pose(*up);
  }
  if (known == std::end(poses)) {
    pose = turned_to_fronts(scene, pose);
  }
  ViewPoint view = view_of_all(scene, pose.toward_eye, pose.up, pose.view_angle, aspect);
  if (pose.radius_fraction < 1) {
    // Fit a sphere around the region of interest.
    view.radius *= pose.radius_fraction;
    const double tangent =
        std::tan(view.view_angle / 2 * std::numbers::pi / 180) * std::min(1.0, aspect);
    view.eye =
        view.target + view.radius / std::sin(std::atan(tangent)) * normalized(pose.toward_eye);
  }
  return view;
}

namespace {

// A unit vector perpendicular to `v`.
Vec3 perpendicular_to(const Vec3& v) {
  const Vec3 other = std::abs(v.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalized(cross(v, other));
}

}  // namespace

ViewPoint standard_view(const Scene& scene, Side side, double aspect,
                        const std::optional<Vec3>& vertical) {
  const ViewPoint first = initial_view(scene, aspect, vertical);
  const Vec3 up = first.up;
  const Vec3 front = normalized(front_of(up) - dot(front_of(up), up) * up);
  const Vec3 right = cross(up, front);
  switch (side) {
    case Side::back:
      return view_of_all(scene, -front, up, first.view_angle, aspect);
    case Side::left:
      return view_of_all(scene, -right, up, first.view_angle, aspect);
    case Side::right:
      return view_of_all(scene, right, up, first.view_angle, aspect);
    case Side::top:
      return view_of_all(scene, up, -front, first.view_angle, aspect);
    case Side::bottom:
      return view_of_all(scene, -up, front, first.view_angle, aspect);
    case Side::front:
      break;
  }
  return view_of_all(scene, front, up, first.view_angle, aspect);
}

ViewPoint fitting_view(const Scene& scene, const ViewPoint& from, double aspect) {
  return view_of_all(scene, from.eye - from.target, from.up, from.view_angle, aspect);
}

ViewPoint patch_view(const Scene& scene, PatchId patch, const ViewPoint& from) {
  const Patch& p = scene.patch(patch);
  double radius = 0;
  for (const PointId corner : scene.outline(patch)) {
    radius = std::max(radius, norm(scene.point(corner) - p.center));
  }
  Vec3 toward_eye = normalized(from.eye - from.target);
  if (dot(toward_eye, p.normal) < 0.2) {
    toward_eye = normalized(toward_eye + (0.6 - dot(toward_eye, p.normal)) * p.normal);
  }
  ViewPoint view = from;
  view.target = p.center;
  // Twice the size of the patch fits into the picture.
  const double distance = 2 * radius / std::sin(0.5 * from.view_angle * std::numbers::pi / 180);
  view.eye = p.center + distance * toward_eye;
  if (norm(cross(view.up, toward_eye)) < 1e-3) {
    view.up = perpendicular_to(toward_eye);
  }
  return view;
}

ViewPoint widened(const ViewPoint& from, double before, double now) {
  constexpr double degree = std::numbers::pi / 180, largest_angle = 150, least_aspect = 1e-3;
  const double factor = std::clamp(before, least_aspect, 1.0) / std::clamp(now, least_aspect, 1.0);
  ViewPoint view = from;
  if (factor != 1) {
    view.view_angle = std::min(
        2 * std::atan(factor * std::tan(from.view_angle / 2 * degree)) / degree, largest_angle);
  }
  return view;
}

ViewPoint turned(const ViewPoint& from, const Vec3& vertical, double azimuth, double elevation) {
  constexpr double degree = std::numbers::pi / 180;
  const Vec3 arm = from.eye - from.target;
  const Vec3 back = normalized(arm);
  const double height = std::clamp(dot(back, vertical), -1.0, 1.0);
  Vec3 level = back - height * vertical;
  if (norm(level) < 1e-6) {  // straight down or up: away from the top of the picture, or toward it
    level = (height > 0 ? -1.0 : 1.0) * (from.up - dot(from.up, vertical) * vertical);
  }
  level = norm(level) < 1e-6 ? perpendicular_to(vertical) : normalized(level);
  level = std::cos(azimuth * degree) * level + std::sin(azimuth * degree) * cross(vertical, level);
  const double tilt = std::clamp(std::asin(height) + elevation * degree, -89 * degree, 89 * degree);
  ViewPoint view = from;
  view.eye = from.target + norm(arm) * (std::cos(tilt) * level + std::sin(tilt) * vertical);
  view.up = vertical;
  return view;
}

void CameraBookmarks::change(const QString& what, std::vector<Bookmark> bookmarks) {
  change_list(undo_, what, bookmarks_, std::move(bookmarks),
              [this](const std::vector<Bookmark>& other) { set(other); });
}

bool CameraBookmarks::has(const QString& name) const {
  return std::any_of(bookmarks_.begin(), bookmarks_.end(),
                     [&](const Bookmark& known) { return known.name == name; });
}

void CameraBookmarks::add(const ViewPoint& view, const QString& name) {
  QString free = name;
  for (std::size_t number = bookmarks_.size() + 1; free.isEmpty() || (name.isEmpty() && has(free));
       ++number) {
    free = tr("View %1").arg(number);
  }
  auto bookmarks = bookmarks_;
  bookmarks.push_back({free, view});
  change(tr("save view: %1").arg(free), std::move(bookmarks));
}

void CameraBookmarks::rename(std::size_t k, const QString& name) {
  if (name.isEmpty() || name == bookmarks_[k].name) {
    return;
  }
  auto bookmarks = bookmarks_;
  bookmarks[k].name = name;
  change(tr("rename view: %1").arg(bookmarks_[k].name), std::move(bookmarks));
}

void CameraBookmarks::remove(std::size_t k) {
  auto bookmarks = bookmarks_;
  bookmarks.erase(bookmarks.begin() + static_cast<std::ptrdiff_t>(k));
  change(tr("remove view: %1").arg(bookmarks_[k].name), std::move(bookmarks));
}

void CameraBookmarks::clear() {
  if (!bookmarks_.empty()) {
    change(tr("remove all saved views"), {});
  }
}

void CameraBookmarks::set(std::vector<Bookmark> bookmarks) {
  bookmarks_ = std::move(bookmarks);
  emit changed();
}

}  // namespace transillum::viewer
