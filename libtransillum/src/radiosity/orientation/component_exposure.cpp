// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Random walks from both sides of the parts of a scene. The walks of a component are numbered, and
// each has its own random numbers, so blocks of walks may run on any thread; the sums of the blocks
// are added in their order.
#include "radiosity/orientation/component_exposure.h"

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
/// Walks on each side: for every component, in `spread_walks` / number of components within these
/// limits …
constexpr std::size_t spread_walks = 1U << 15, least_walks = 8, most_walks = 64;
/// … and shared out by area.
constexpr double area_walks = 1 << 13;
/// Walks that one thread makes between checks of the cancellation, and blocks of them between
/// reports of progress.
constexpr std::size_t walks_in_block = 512, blocks_in_batch = 64;

class ExposureMeter {
 public:
  ExposureMeter(const Scene& scene, const EmbreeScene& embree,
                const ConnectedComponents& components)
      : scene_(scene),
        embree_(embree),
        components_(components),
        patches_(patches_by_surface()),
        points_(scene, embree, patches_),
        has_light_(scene.has_light()) {
    area_ = total_area(scene);
    const std::size_t each =
        std::clamp(spread_walks / std::max<std::size_t>(1, components.components.size()),
                   least_walks, most_walks);
    first_walk_.push_back(0);
    for (const ConnectedComponent& component : components.components) {
      const auto by_area = static_cast<std::size_t>(std::ceil(area_walks * component.area / area_));
      first_walk_.push_back(first_walk_.back() + each + by_area);
    }
  }

  std::vector<ComponentExposure> measure(int threads, const Cancellation& cancellation,
                                         const std::function<void(double)>& progress) {
    const std::size_t blocks = (first_walk_.back() + walks_in_block - 1) / walks_in_block;
    std::vector<ComponentExposure> sums(components_.components.size());
    std::vector<std::vector<ComponentSum>> batch(blocks_in_batch);
    WorkerThreads workers(thread_count(threads));
    for (std::size_t begin = 0; begin < blocks; begin += blocks_in_batch) {
      const std::size_t end = std::min(blocks, begin + blocks_in_batch);
      for_each_index(workers, begin, end, [&](std::size_t block) {
        cancellation.throw_if_canceled();
        batch[block - begin] = walk_block(block);
      });
      for (std::size_t block = begin; block < end; ++block) {
        for (const ComponentSum& sum : batch[block - begin]) {
          add(sums[sum.component], sum.exposure);
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
                scale * side.met_closed, scale * side.lit};
      }
    }
    return sums;
  }

 private:
  struct ComponentSum {
    std::size_t component;
    ComponentExposure exposure;
  };

  std::vector<PatchId> patches_by_surface() {
    std::vector<PatchId> patches;
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (at(components_.component, i) != ConnectedComponents::none) {
        patches.push_back(i);
      }
    }
    std::stable_sort(patches.begin(), patches.end(), [this](PatchId a, PatchId b) {
      return at(components_.component, a) < at(components_.component, b);
    });
    first_patch_.assign(components_.components.size() + 1, patches.size());
    for (std::size_t k = patches.size(); k-- > 0;) {
      at(first_patch_, at(components_.component, patches[k])) = k;
    }
    return patches;
  }

  static void add(ComponentExposure& sum, const ComponentExposure& exposure) {
    for (std::size_t side = 0; side < sum.size(); ++side) {
      sum[side].other_area += exposure[side].other_area;
      sum[side].own_area += exposure[side].own_area;
      sum[side].met_other += exposure[side].met_other;
      sum[side].met_closed += exposure[side].met_closed;
      sum[side].lit += exposure[side].lit;
    }
  }

  std::vector<ComponentSum> walk_block(std::size_t block) const {
    const std::size_t begin = block * walks_in_block,
                      end = std::min(begin + walks_in_block, first_walk_.back());
    std::vector<ComponentSum> sums;
    auto component = static_cast<std::size_t>(
        std::upper_bound(first_walk_.begin(), first_walk_.end(), begin) - first_walk_.begin() - 1);
    for (std::size_t walk = begin; walk < end; ++walk) {
      while (walk >= first_walk_[component + 1]) {
        ++component;
      }
      if (sums.empty() || sums.back().component != component) {
        sums.push_back({component, {}});
      }
      const ComponentExposure exposure{walk_from(component, walk, 0),
                                       walk_from(component, walk, 1)};
      add(sums.back().exposure, exposure);
    }
    return sums;
  }

  bool is_closed(PatchId i) const {
    const std::int32_t component = at(components_.component, i);
    return component != ConnectedComponents::none && at(components_.components, component).closed;
  }

  /// One walk from a random point of a component.
  /// @param side 0: the side that patches of sign 1 front.
  SideExposure walk_from(std::size_t component, std::size_t walk, std::size_t side) const {
    RandomNumbers random(2 * walk + side);
    const std::size_t number = walk - first_walk_[component],
                      count = first_walk_[component + 1] - first_walk_[component];
    // One walk starts in each of equal fractions of the area.
    const double where = (static_cast<double>(number) + random.next()) / static_cast<double>(count);
    const auto start =
        points_.point(points_.range(first_patch_[component], first_patch_[component + 1]),
                      std::min(where, 0x1.fffffffffffffp-1), random);
    const bool front = (at(components_.sign, start.patch) > 0) == (side == 0);
    Vec3 normal = front ? scene_.patch(start.patch).normal : -scene_.patch(start.patch).normal;
    Vec3 position = start.position;
    std::array<PatchId, longest_walk + 1> reached{at(components_.first, start.patch)};
    SideExposure exposure;
    for (std::size_t step = 1; step <= longest_walk; ++step) {
      const Vec3 direction = diffuse_direction(normal, random), from = position + ray_lift * normal;
      const auto meeting = first_meeting(embree_, from, direction);
      if (!meeting) {
        exposure.lit = has_light_ ? exposure.lit : 1;
        break;
      }
      const Patch& patch = scene_.patch(meeting->patch);
      reached[step] = at(components_.first, meeting->patch);
      if (std::find(reached.begin(), reached.begin() + static_cast<std::ptrdiff_t>(step),
                    reached[step]) == reached.begin() + static_cast<std::ptrdiff_t>(step)) {
        const bool own =
            at(components_.component, reached[step]) == static_cast<std::int32_t>(component);
        (own ? exposure.own_area : exposure.other_area) += patch.area / area_;
        exposure.met_other = own ? exposure.met_other : 1;
        exposure.met_closed = !own && is_closed(reached[step]) ? 1 : exposure.met_closed;
        exposure.lit = !own && max_abs(scene_.exitance(reached[step])) > 0 ? 1 : exposure.lit;
      }
      normal = dot(patch.normal, direction) < 0 ? patch.normal : -patch.normal;
      position = from + static_cast<double>(meeting->distance) * direction;
    }
    return exposure;
  }

  const Scene& scene_;
  const EmbreeScene& embree_;
  const ConnectedComponents& components_;
  std::vector<std::size_t>
      first_patch_;               ///< by component: its first place in patches_; and the end
  std::vector<PatchId> patches_;  ///< by component
  SurfacePoints points_;
  bool has_light_;
  double area_ = 0;                      ///< area of all patches
  std::vector<std::size_t> first_walk_;  ///< by component; and the end
};

}  // namespace

std::vector<ComponentExposure> measure_exposure(const Scene& scene, const EmbreeScene& embree,
                                                const ConnectedComponents& components, int threads,
                                                const Cancellation& cancellation,
                                                const std::function<void(double)>& progress) {
  return ExposureMeter(scene, embree, components).measure(threads, cancellation, progress);
}

}  // namespace transillum
