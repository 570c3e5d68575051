// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "visibility/pixels/patch_heights.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "transillum/at.h"
#include "transillum/bsp_tree.h"

namespace transillum {

PatchHeights::PatchHeights(const Scene& scene, const PlaneFrame& frame, double snapping)
    : scene_(scene),
      frame_(frame),
      snapping_(snapping),
      planes_(static_cast<std::size_t>(scene.patch_count())) {
  constexpr double least_cosine = 1e-7;
  const double thickness = BspTree::thickness(scene);
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    const Patch& patch = scene.patch(i);
    const double cosine = dot(patch.normal, frame.omega);
    if (std::abs(cosine) < least_cosine) {
      continue;
    }
    at(planes_, i) = {cosine, dot(patch.normal, patch.center - frame.origin) / cosine,
                      -dot(patch.normal, frame.u) / cosine, -dot(patch.normal, frame.v) / cosine,
                      thickness / std::abs(cosine)};
  }
}

bool PatchHeights::comes_first(PatchId a, PatchId b) const {
  // Receivers before emitters; covering patches first among receivers, last among emitters.
  if (front_facing(a) != front_facing(b)) {
    return front_facing(a);
  }
  const auto rank = [this](PatchId i) {
    return std::tuple(-max_abs(scene_.exitance(i)), scene_.patch(i).area, -i);
  };
  return front_facing(a) ? rank(a) < rank(b) : rank(b) < rank(a);
}

/// 1 if patch i lies above the plane of j, -1 if below it, 0 if in it or on both sides.
int PatchHeights::side_of(PatchId i, PatchId j) const {
  bool above = false, below = false;
  for (const PointId p : scene_.outline(i)) {
    const Vec3& corner = scene_.point(p);
    const double over =
        dot(corner - frame_.origin, frame_.omega) - height(j, frame_.project(corner));
    above = above || over > slack(j);
    below = below || over < -slack(j);
  }
  return (above ? 1 : 0) - (below ? 1 : 0);
}

bool PatchHeights::above(const HeightSample& a, const HeightSample& b) const {
  const PatchPlane &p = plane(a.patch), &q = plane(b.patch);
  const double slack = p.slack + q.slack;
  const double bend = std::abs(p.along_x - q.along_x) + std::abs(p.along_y - q.along_y);
  if (std::abs(a.height - b.height) > slack + bend * snapping_) {
    return a.height > b.height;
  }
  // Their planes meet here, for instance at a shared edge: compare on which side of the planes the
  // patches lie.
  const int higher = side_of(a.patch, b.patch) - side_of(b.patch, a.patch);
  if (higher != 0) {
    return higher > 0;
  }
  if (std::abs(a.height - b.height) > slack) {
    return a.height > b.height;
  }
  return comes_first(a.patch, b.patch);
}

PatchHeights::HeightSample* PatchHeights::sort(HeightSample* first, HeightSample* last) const {
  std::sort(first, last, [](const HeightSample& a, const HeightSample& b) {
    return std::pair(-a.height, a.patch) < std::pair(-b.height, b.patch);
  });
  // A line can meet two pieces of a patch at their common edge.
  last = std::unique(
      first, last, [](const HeightSample& a, const HeightSample& b) { return a.patch == b.patch; });
  // above() is not transitive, so std::sort cannot use it. Insertion sort: few elements move.
  for (HeightSample* a = first + (first != last); a < last; ++a) {
    for (HeightSample* b = a; b > first && above(b[0], b[-1]); --b) {
      std::swap(b[0], b[-1]);
    }
  }
  return last;
}

void PatchHeights::sort(std::vector<HeightSample>& samples) const {
  samples.resize(static_cast<std::size_t>(sort(samples.data(), samples.data() + samples.size()) -
                                          samples.data()));
}

}  // namespace transillum
