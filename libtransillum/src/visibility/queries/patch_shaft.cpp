// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/queries/patch_shaft.h"

#include <algorithm>

#include "transillum/at.h"

namespace transillum {

template <class Points>
PatchShaft::Sphere PatchShaft::bounding_sphere(const Points& points) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 center = (low + high) / 2;
  double radius = 0;
  for (const Vec3& p : points) {
    radius = std::max(radius, norm(p - center));
  }
  // Distances lose digits far from the origin and between points far apart along the direction.
  return {center, radius + 1e-6 * (radius + norm(center))};
}

PatchShaft::PatchShaft(const Scene& scene, const BspTree& tree, PatchId patch) {
  std::vector<Vec3> points, own;
  spheres_.reserve(tree.fragments().size());
  for (const BspTree::Fragment& fragment : tree.fragments()) {
    points.clear();
    for (const BspTree::Corner& corner : tree.corners(fragment)) {
      points.push_back(at(tree.points(), corner.point));
    }
    spheres_.push_back(bounding_sphere(points));
    if (fragment.patch == patch) {
      own.insert(own.end(), points.begin(), points.end());
    }
  }
  patch_ = own.empty() ? Sphere{scene.patch(patch).center, 0} : bounding_sphere(own);
}

}  // namespace transillum
