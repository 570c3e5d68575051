// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Finds pairs of coplanar patches that overlap, which input files usually contain by mistake.
// Input: the pieces of a scene, which are compared pairwise by bounding boxes, then by planes, then
// by clipping. No BSP tree is needed, whose construction may take much longer.
#include "visibility/bsp/coplanar_overlap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/box_tree.h"
#include "geometry/form_factor.h"
#include "scene/build/cover_rank.h"
#include "transillum/bsp_tree.h"

namespace transillum {
namespace {

class OverlapFinder {
 public:
  OverlapFinder(const Scene& scene, std::size_t max_pairs, const Cancellation& cancellation)
      : scene_(scene),
        thickness_(BspTree::thickness(scene)),
        max_pairs_(max_pairs),
        cancellation_(cancellation) {
    boxes_.resize(scene.pieces().size());
    for (std::size_t p = 0; p < boxes_.size(); ++p) {
      for (const PointId corner : scene.corners(scene.pieces()[p])) {
        boxes_[p].add(scene.point(corner));
      }
    }
  }

  std::vector<CoplanarOverlap> find() {
    const BoxTree tree(boxes_);
    for (std::size_t p = 0; p < boxes_.size() && areas_.size() < max_pairs_; ++p) {
      cancellation_.throw_if_canceled();
      const Vec3 center = boxes_[p].center(), half = 0.5 * (boxes_[p].high - boxes_[p].low);
      const auto reaches = [&](const CenteredBox& box) {
        const Vec3 apart = box.center - center, sum = box.half + half;
        return std::abs(apart.x) <= sum.x + thickness_ && std::abs(apart.y) <= sum.y + thickness_ &&
               std::abs(apart.z) <= sum.z + thickness_;
      };
      tree.for_each(reaches, [&](std::int32_t other) {
        const auto q = static_cast<std::size_t>(other);
        if (q > p && areas_.size() < max_pairs_ && (lies_in(q, p) || lies_in(p, q))) {
          add_overlap(p, q);
        }
      });
    }
    std::vector<CoplanarOverlap> overlaps;
    overlaps.reserve(areas_.size());
    for (const auto& [pair, area] : areas_) {
      overlaps.push_back({pair.first, pair.second, area});
    }
    return overlaps;
  }

 private:
  PatchId patch_of(std::size_t piece) const { return scene_.pieces()[piece].patch; }

  Corners outline(std::size_t piece) const {
    Corners corners;
    for (const PointId corner : scene_.corners(scene_.pieces()[piece])) {
      corners.push_back(scene_.point(corner));
    }
    return corners;
  }

  /// Whether a piece lies in the plane of another.
  bool lies_in(std::size_t piece, std::size_t plane) const {
    const Patch& patch = scene_.patch(patch_of(plane));
    const auto corners = scene_.corners(scene_.pieces()[piece]);
    return std::all_of(corners.begin(), corners.end(), [&](PointId corner) {
      return std::abs(dot(patch.normal, scene_.point(corner) - patch.center)) <= thickness_;
    });
  }

  /// Adds the area in which two pieces overlap, if any.
  void add_overlap(std::size_t p, std::size_t q) {
    const PatchId a = patch_of(p), b = patch_of(q);
    if (a == b || dot(scene_.patch(a).normal, scene_.patch(b).normal) <= 0) {
      return;
    }
    const Corners cover = outline(p);
    const Vec3 normal = scene_.patch(a).normal;
    Corners common = outline(q);
    for (std::size_t k = 0; k < cover.size() && !common.empty(); ++k) {
      if (k % 256 == 0) {
        cancellation_.throw_if_canceled();
      }
      const Vec3& from = cover[k];
      const Vec3 inward = cross(normal, cover[k + 1 < cover.size() ? k + 1 : 0] - from);
      const double length = norm(inward);
      if (length == 0) {
        continue;
      }
      common = clipped(common, {inward / length, dot(inward / length, from) + thickness_});
    }
    if (common.empty()) {
      return;
    }
    if (const double area = norm(area_vector(common)); area > 0) {
      const bool a_covers = cover_rank(scene_, a) < cover_rank(scene_, b);
      areas_[a_covers ? std::pair(a, b) : std::pair(b, a)] += area;
    }
  }

  const Scene& scene_;
  const double thickness_;
  const std::size_t max_pairs_;
  const Cancellation& cancellation_;
  std::vector<Bounds> boxes_;  ///< by piece
  std::map<std::pair<PatchId, PatchId>, double> areas_;
};

}  // namespace

std::vector<CoplanarOverlap> coplanar_overlaps(const Scene& scene, std::size_t most,
                                               const Cancellation& cancellation) {
  return OverlapFinder(scene, most, cancellation).find();
}

}  // namespace transillum
