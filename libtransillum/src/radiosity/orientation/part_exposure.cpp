// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Random walks from both sides of the parts of a scene. The walks of a part are numbered, and each
// has its own random numbers, so blocks of walks may run on any thread; the sums of the blocks are
// added in their order.
#include "radiosity/orientation/part_exposure.h"

#include <algorithm>
#include <cmath>

#include "base/for_each_index.h"
#include "radiosity/norms.h"
#include "radiosity/orientation/surface_rays.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// Surfaces that a walk meets at most.
constexpr std::size_t longest_walk = 8;
/// Walks on each side: for every part, in `spread_walks` / number of parts within these limits …
constexpr std::size_t spread_walks = 1U << 15, least_walks = 8, most_walks = 64;
/// … and shared out by area.
constexpr double area_walks = 1 << 13;
/// Walks that one thread makes between checks of the cancellation, and blocks of them between
/// reports of progress.
constexpr std::size_t walks_in_block = 512, blocks_in_round = 64;

class ExposureMeter {
 public:
  ExposureMeter(const Scene& scene, const EmbreeScene& embree, const SurfaceParts& parts)
      : scene_(scene),
        embree_(embree),
        parts_(parts),
        patches_(patches_by_part()),
        points_(scene, embree, patches_),
        has_light_(scene.has_light()) {
    area_ = total_area(scene);
    const std::size_t each = std::clamp(spread_walks / std::max<std::size_t>(1, parts.parts.size()),
                                        least_walks, most_walks);
    first_walk_.push_back(0);
    for (const SurfacePart& part : parts.parts) {
      const auto by_area = static_cast<std::size_t>(std::ceil(area_walks * part.area / area_));
      first_walk_.push_back(first_walk_.back() + each + by_area);
    }
  }

  std::vector<PartExposure> measure(int threads, const Cancellation& cancellation,
                                    const std::function<void(double)>& progress) {
    const std::size_t blocks = (first_walk_.back() + walks_in_block - 1) / walks_in_block;
    std::vector<PartExposure> sums(parts_.parts.size());
    std::vector<std::vector<PartSum>> round(blocks_in_round);
    WorkerThreads workers(thread_count(threads));
    for (std::size_t begin = 0; begin < blocks; begin += blocks_in_round) {
      const std::size_t end = std::min(blocks, begin + blocks_in_round);
      for_each_index(workers, begin, end, [&](std::size_t block) {
        cancellation.throw_if_canceled();
        round[block - begin] = walk_block(block);
      });
      for (std::size_t block = begin; block < end; ++block) {
        for (const PartSum& sum : round[block - begin]) {
          add(sums[sum.part], sum.exposure);
        }
      }
      if (progress) {
        progress(static_cast<double>(end) / static_cast<double>(blocks));
      }
    }
    for (std::size_t p = 0; p < sums.size(); ++p) {
      const double scale = 1 / static_cast<double>(first_walk_[p + 1] - first_walk_[p]);
      for (SideExposure& side : sums[p]) {
        side = {scale * side.other_area, scale * side.own_area, scale * side.met_other,
                scale * side.lit};
      }
    }
    return sums;
  }

 private:
  struct PartSum {
    std::size_t part;
    PartExposure exposure;
  };

  std::vector<PatchId> patches_by_part() {
    std::vector<PatchId> patches;
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (at(parts_.part, i) != SurfaceParts::none) {
        patches.push_back(i);
      }
    }
    std::stable_sort(patches.begin(), patches.end(), [this](PatchId a, PatchId b) {
      return at(parts_.part, a) < at(parts_.part, b);
    });
    first_patch_.assign(parts_.parts.size() + 1, patches.size());
    for (std::size_t k = patches.size(); k-- > 0;) {
      at(first_patch_, at(parts_.part, patches[k])) = k;
    }
    return patches;
  }

  static void add(PartExposure& sum, const PartExposure& exposure) {
    for (std::size_t side = 0; side < sum.size(); ++side) {
      sum[side].other_area += exposure[side].other_area;
      sum[side].own_area += exposure[side].own_area;
      sum[side].met_other += exposure[side].met_other;
      sum[side].lit += exposure[side].lit;
    }
  }

  std::vector<PartSum> walk_block(std::size_t block) const {
    const std::size_t begin = block * walks_in_block,
                      end = std::min(begin + walks_in_block, first_walk_.back());
    std::vector<PartSum> sums;
    auto part = static_cast<std::size_t>(
        std::upper_bound(first_walk_.begin(), first_walk_.end(), begin) - first_walk_.begin() - 1);
    for (std::size_t walk = begin; walk < end; ++walk) {
      while (walk >= first_walk_[part + 1]) {
        ++part;
      }
      if (sums.empty() || sums.back().part != part) {
        sums.push_back({part, {}});
      }
      const PartExposure exposure{walk_from(part, walk, 0), walk_from(part, walk, 1)};
      add(sums.back().exposure, exposure);
    }
    return sums;
  }

  /// One walk from a random point of a part.
  /// @param side 0: the side that patches of sign 1 front.
  SideExposure walk_from(std::size_t part, std::size_t walk, std::size_t side) const {
    RandomNumbers random(2 * walk + side);
    const std::size_t number = walk - first_walk_[part],
                      count = first_walk_[part + 1] - first_walk_[part];
    // One walk starts in each of equal shares of the area.
    const double where = (static_cast<double>(number) + random.next()) / static_cast<double>(count);
    const auto start = points_.point(points_.range(first_patch_[part], first_patch_[part + 1]),
                                     std::min(where, 0x1.fffffffffffffp-1), random);
    const bool front = (at(parts_.sign, start.patch) > 0) == (side == 0);
    Vec3 normal = front ? scene_.patch(start.patch).normal : -scene_.patch(start.patch).normal;
    Vec3 position = start.position;
    std::array<PatchId, longest_walk + 1> reached{at(parts_.first, start.patch)};
    SideExposure exposure;
    for (std::size_t step = 1; step <= longest_walk; ++step) {
      const Vec3 direction = diffuse_direction(normal, random), from = position + ray_lift * normal;
      const auto meeting = first_meeting(embree_, from, direction);
      if (!meeting) {
        exposure.lit = has_light_ ? exposure.lit : 1;
        break;
      }
      const Patch& patch = scene_.patch(meeting->patch);
      reached[step] = at(parts_.first, meeting->patch);
      if (std::find(reached.begin(), reached.begin() + static_cast<std::ptrdiff_t>(step),
                    reached[step]) == reached.begin() + static_cast<std::ptrdiff_t>(step)) {
        const bool own = at(parts_.part, reached[step]) == static_cast<std::int32_t>(part);
        (own ? exposure.own_area : exposure.other_area) += patch.area / area_;
        exposure.met_other = own ? exposure.met_other : 1;
        exposure.lit = !own && max_abs(scene_.exitance(reached[step])) > 0 ? 1 : exposure.lit;
      }
      normal = dot(patch.normal, direction) < 0 ? patch.normal : -patch.normal;
      position = from + static_cast<double>(meeting->distance) * direction;
    }
    return exposure;
  }

  const Scene& scene_;
  const EmbreeScene& embree_;
  const SurfaceParts& parts_;
  std::vector<std::size_t> first_patch_;  ///< by part: its first place in patches_; and the end
  std::vector<PatchId> patches_;          ///< by part
  SurfacePoints points_;
  bool has_light_;
  double area_ = 0;                      ///< area of all patches
  std::vector<std::size_t> first_walk_;  ///< by part; and the end
};

}  // namespace

std::vector<PartExposure> measure_exposure(const Scene& scene, const EmbreeScene& embree,
                                           const SurfaceParts& parts, int threads,
                                           const Cancellation& cancellation,
                                           const std::function<void(double)>& progress) {
  return ExposureMeter(scene, embree, parts).measure(threads, cancellation, progress);
}

}  // namespace transillum
