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

// A unit vector perpendicular to `v`.
Vec3 perpendicular_to(const Vec3& v) {
  const Vec3 other = std::abs(v.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalized(cross(v, other));
}

}  // namespace

ViewPoint standard_view(const Scene& scene, Side side, double aspect) {
  const ViewPoint first = initial_view(scene, aspect);
  const Vec3 up = first.up;
  // If z is up, the front view is along +y, as in a plan; if y is up, along -z, as on a screen.
  const Vec3 front = std::abs(up.z) > 0.5 ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
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
