// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/grid_projection.h"

#include <array>
#include <cmath>

#include "transillum/at.h"

namespace transillum {

void GridProjection::project(const Scene& scene, const BspTree& tree, const Vec3& omega,
                             const Cancellation& cancellation) {
  frame = plane_frame(scene, omega);
  // The grid has more than the 53 bits of a double.
  using Wide = long double;
  const double radius = 0.5 * scene.bounds().diagonal();
  int exponent = 0;
  std::frexp(radius, &exponent);  // radius < 2^exponent, and no point lies farther out
  unit = std::ldexp(1.0, exponent - 60);
  const Wide scale = 1 / static_cast<Wide>(unit);
  const auto scaled = [scale](const Vec3& axis) {
    return std::array<Wide, 3>{scale * axis.x, scale * axis.y, scale * axis.z};
  };
  const auto u = scaled(frame.u), v = scaled(frame.v);

  points.clear();
  points.reserve(tree.points().size());
  const auto check_cancellation = [&] {
    if (points.size() % 16384 == 0) {
      cancellation.throw_if_canceled();
    }
  };
  for (const Vec3& p : scene.points()) {
    check_cancellation();
    const Wide x = static_cast<Wide>(p.x) - frame.origin.x;
    const Wide y = static_cast<Wide>(p.y) - frame.origin.y;
    const Wide z = static_cast<Wide>(p.z) - frame.origin.z;
    points.push_back(
        {std::llrint(u[0] * x + u[1] * y + u[2] * z), std::llrint(v[0] * x + v[1] * y + v[2] * z)});
  }
  for (const BspTree::CutPoint& cut : tree.cut_points()) {
    check_cancellation();
    const GridPoint a = at(points, cut.a);
    const GridPoint b = at(points, cut.b);
    points.push_back({a.x + std::llrint(cut.t * static_cast<Wide>(b.x - a.x)),
                      a.y + std::llrint(cut.t * static_cast<Wide>(b.y - a.y))});
  }
}

GridPoint GridProjection::point_at(const Vec3& point) const {
  using Wide = long double;
  const Vec3& o = frame.origin;
  const Wide x = static_cast<Wide>(point.x) - o.x, y = static_cast<Wide>(point.y) - o.y,
             z = static_cast<Wide>(point.z) - o.z;
  const auto along = [&](const Vec3& axis) {
    return std::llrint((axis.x * x + axis.y * y + axis.z * z) / unit);
  };
  return {along(frame.u), along(frame.v)};
}

}  // namespace transillum
