// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/projection.h"

#include <cmath>

namespace transillum {

PlaneFrame plane_frame(const Scene& scene, const Vec3& omega) {
  // The axis most across omega gives the plane's "up" a steady meaning: z where possible.
  const Vec3 up = std::abs(omega.z) < 0.95 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  PlaneFrame frame;
  frame.origin = scene.bounds().center();
  frame.omega = omega;
  frame.u = normalized(cross(up, omega));
  frame.v = cross(omega, frame.u);
  return frame;
}

Projection::Projection(const Scene& scene, const BspTree& tree, const Vec3& omega)
    : frame(plane_frame(scene, omega)) {
  points.reserve(tree.points().size());
  const auto along = [this](const Vec3& axis, const Vec3& p) {
    return static_cast<Real>(axis.x) * (static_cast<Real>(p.x) - frame.origin.x) +
           static_cast<Real>(axis.y) * (static_cast<Real>(p.y) - frame.origin.y) +
           static_cast<Real>(axis.z) * (static_cast<Real>(p.z) - frame.origin.z);
  };
  for (const Vec3& p : scene.points()) points.push_back({along(frame.u, p), along(frame.v, p)});
  for (const BspTree::CutPoint& cut : tree.cut_points()) {
    const PlanePoint a = points[static_cast<std::size_t>(cut.a)];
    const PlanePoint b = points[static_cast<std::size_t>(cut.b)];
    points.push_back({a.x + cut.t * (b.x - a.x), a.y + cut.t * (b.y - a.y)});
  }
  lines.reserve(tree.lines().size());
  for (const BspTree::Line& line : tree.lines()) {
    const PlanePoint a = points[static_cast<std::size_t>(line.a)];
    lines.push_back({a, points[static_cast<std::size_t>(line.b)] - a});
  }
}

}  // namespace transillum
