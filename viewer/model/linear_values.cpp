// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "model/linear_values.h"

#include <algorithm>
#include <cmath>

#include "transillum/at.h"

namespace transillum::viewer {

Rgb value_at(const Rgb& mean, const LinearPart& part, const LinearBasis& basis, const Vec3& point) {
  const auto [first, second] = basis.at(point);
  return mean + first * part.first + second * part.second;
}

Rgb radiosity_at(const SolverSnapshot& snapshot, PatchId i, const Vec3& point) {
  const Rgb& mean = at(snapshot.radiosity, i);
  return snapshot.linear_parts.empty()
             ? mean
             : value_at(mean, at(snapshot.linear_parts, i), at(*snapshot.bases, i), point);
}

std::int64_t count_negative_corners(const SolverSnapshot& snapshot) {
  const Scene& scene = *snapshot.loaded->scene;
  std::int64_t count = 0;
  for (PatchId i = 0; i < std::ssize(snapshot.linear_parts); ++i) {
    for (const PointId corner : scene.outline(i)) {
      const Rgb b = radiosity_at(snapshot, i, scene.point(corner));
      count += std::min({b.r, b.g, b.b}) < 0 ? 1 : 0;
    }
  }
  return count;
}

std::optional<Vec3> point_of_patch(const PlaneFrame& frame, const Vec2& p, const Patch& patch) {
  const double cosine = dot(patch.normal, frame.omega);
  if (std::abs(cosine) < 1e-9) {
    return std::nullopt;
  }
  const Vec3 on_plane = frame.origin + p.x * frame.u + p.y * frame.v;
  return on_plane + (dot(patch.normal, patch.center - on_plane) / cosine) * frame.omega;
}

}  // namespace transillum::viewer
