// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "transillum/linear_basis.h"

#include <cmath>

namespace transillum {
namespace {

/// A point in the plane of a patch, relative to a corner of it, m.
struct Local {
  double u = 0, v = 0;
};

/// Integrals over a polygon of 1 and of products of its coordinates relative to a center.
struct Moments {
  double area = 0, uu = 0, uv = 0, vv = 0;
};

/// The centroid, by the signed triangles of the corners with the first one.
Local centroid(const std::vector<Local>& corners) {
  double area = 0;
  Local sum;
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Local &a = corners[k - 1], &b = corners[k];
    const double twice = a.u * b.v - a.v * b.u;
    area += twice;
    sum.u += twice * (a.u + b.u);
    sum.v += twice * (a.v + b.v);
  }
  return {sum.u / (3 * area), sum.v / (3 * area)};
}

/// Moments relative to `center`, by the signed triangles of the edges with it.
Moments moments_about(const Local& center, const std::vector<Local>& corners) {
  Moments sum;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Local &p = corners[k], &q = corners[k + 1 < corners.size() ? k + 1 : 0];
    const Local a{p.u - center.u, p.v - center.v}, b{q.u - center.u, q.v - center.v};
    const double twice = a.u * b.v - a.v * b.u;
    sum.area += twice / 2;
    sum.uu += twice / 12 * (a.u * a.u + a.u * b.u + b.u * b.u);
    sum.vv += twice / 12 * (a.v * a.v + a.v * b.v + b.v * b.v);
    sum.uv += twice / 24 * (2 * a.u * a.v + 2 * b.u * b.v + a.u * b.v + a.v * b.u);
  }
  return sum;
}

/// The direction of the longest edge, in the plane of the patch.
Vec3 longest_edge(const Scene& scene, PatchId i) {
  const auto outline = scene.outline(i);
  Vec3 longest;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec3 edge =
        scene.point(outline[k + 1 < outline.size() ? k + 1 : 0]) - scene.point(outline[k]);
    if (norm(edge) > norm(longest)) {
      longest = edge;
    }
  }
  const Vec3& normal = scene.patch(i).normal;
  return normalized(longest - dot(longest, normal) * normal);
}

}  // namespace

LinearBasis linear_basis(const Scene& scene, PatchId i) {
  const Vec3 along = longest_edge(scene, i), across = cross(scene.patch(i).normal, along);
  const auto outline = scene.outline(i);
  const Vec3& origin = scene.point(outline[0]);
  std::vector<Local> corners;
  for (const PointId p : outline) {
    const Vec3 offset = scene.point(p) - origin;
    corners.push_back({dot(along, offset), dot(across, offset)});
  }
  const Local center = centroid(corners);
  const Moments m = moments_about(center, corners);
  // Gram and Schmidt: phi_1 = u / s, phi_2 = (v - t u) / r.
  const double s = std::sqrt(m.uu / m.area), t = m.uv / m.uu;
  const double r = std::sqrt((m.vv - t * m.uv) / m.area);
  return {origin + center.u * along + center.v * across,
          {(1 / s) * along, (1 / r) * (across - t * along)}};
}

std::vector<LinearBasis> linear_bases(const Scene& scene) {
  std::vector<LinearBasis> bases;
  bases.reserve(scene.patches().size());
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    bases.push_back(linear_basis(scene, i));
  }
  return bases;
}

}  // namespace transillum
