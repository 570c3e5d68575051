// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Finds pairs of coplanar patches that overlap, which input files usually contain by mistake.
// Input: the nodes of a BSP tree, whose fragments in one plane are compared pairwise by bounding
// boxes, then by clipping.
#include "transillum/coplanar_overlap.h"

#include <map>
#include <utility>

#include "geometry/box_tree.h"
#include "geometry/form_factor.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Finds overlaps node by node: coplanar fragments that overlap are in the same node of the tree.
class OverlapFinder {
 public:
  OverlapFinder(const Scene& scene, const BspTree& tree, std::size_t max_pairs,
                const Cancellation& cancellation)
      : tree_(tree),
        thickness_(BspTree::thickness(scene)),
        max_pairs_(max_pairs),
        cancellation_(cancellation) {}

  std::vector<CoplanarOverlap> find() {
    for (const BspTree::Node& node : tree_.nodes()) {
      find_among(node.begin, node.middle);
      find_among(node.middle, node.end);
    }
    std::vector<CoplanarOverlap> overlaps;
    overlaps.reserve(areas_.size());
    for (const auto& [pair, area] : areas_) {
      overlaps.push_back({pair.first, pair.second, area});
    }
    return overlaps;
  }

 private:
  Corners outline(FragmentId f) const {
    Corners corners;
    for (const BspTree::Corner& corner : tree_.corners(tree_.fragment(f))) {
      corners.push_back(at(tree_.points(), corner.point));
    }
    return corners;
  }

  /// Finds overlaps among fragments of one plane and one orientation; those that cover others come
  /// first.
  void find_among(FragmentId begin, FragmentId end) {
    if (end - begin < 2) {
      return;
    }
    std::vector<Bounds> boxes(static_cast<std::size_t>(end - begin));
    for (FragmentId f = begin; f < end; ++f) {
      for (const Vec3& corner : outline(f)) {
        at(boxes, f - begin).add(corner);
      }
    }
    const BoxTree box_tree(boxes);
    for (FragmentId f = begin; f < end && areas_.size() < max_pairs_; ++f) {
      cancellation_.throw_if_canceled();
      const Bounds& own = at(boxes, f - begin);
      const Vec3 center = own.center(), half = 0.5 * (own.high - own.low);
      const auto reaches = [&](const CenteredBox& box) {
        const Vec3 apart = box.center - center, sum = box.half + half;
        return std::abs(apart.x) <= sum.x + thickness_ && std::abs(apart.y) <= sum.y + thickness_ &&
               std::abs(apart.z) <= sum.z + thickness_;
      };
      box_tree.for_each(reaches, [&](std::int32_t other) {
        if (begin + other > f && areas_.size() < max_pairs_) {
          add_overlap(f, begin + other);
        }
      });
    }
  }

  /// Adds the area in which two fragments overlap, if any.
  void add_overlap(FragmentId upper, FragmentId lower) {
    const PatchId a = tree_.fragment(upper).patch, b = tree_.fragment(lower).patch;
    if (a == b) {
      return;
    }
    const Corners cover = outline(upper);
    const Vec3 normal = lit_half_space(cover).normal;
    Corners common = outline(lower);
    for (std::size_t k = 0; k < cover.size() && !common.empty(); ++k) {
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
    const double area = norm(area_vector(common));
    if (area > 0) {
      areas_[{a, b}] += area;
    }
  }

  const BspTree& tree_;
  const double thickness_;
  const std::size_t max_pairs_;
  const Cancellation& cancellation_;
  std::map<std::pair<PatchId, PatchId>, double> areas_;
};

}  // namespace

std::vector<CoplanarOverlap> coplanar_overlaps(const Scene& scene, const BspTree& tree,
                                               std::size_t most, const Cancellation& cancellation) {
  return OverlapFinder(scene, tree, most, cancellation).find();
}

}  // namespace transillum
