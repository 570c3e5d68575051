// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What the lit sides of a scene see, by random rays: how much of it is a back, and how much
// nothing. Each ray has its own random numbers; results are counts, so the order of rays does not
// matter.
#include <algorithm>
#include <numeric>
#include <utility>

#include "radiosity/for_each_index.h"
#include "radiosity/orientation/surface_rays.h"
#include "radiosity/two_sided.h"
#include "transillum/orientation.h"

namespace transillum {
namespace {

constexpr std::size_t ray_count = 1U << 17, rays_in_block = 1024;
/// Share of the rays below which lit sides see nothing that counts.
constexpr double nothing = 1e-3;

/// What one ray found.
struct RayResult {
  PatchId patch = no_patch;  ///< seen from the lit side; or no_patch
  bool back = false;         ///< its back was seen
  bool open = false;         ///< nothing was met; on a two-sided face, nothing on either side
  bool dark_inside = false;  ///< the ray from the viewer's back side met a back
};

class RaySampler {
 public:
  RaySampler(const Scene& scene, const Cancellation& cancellation)
      : scene_(scene), embree_(scene, cancellation), points_(scene, embree_, all_patches(scene)) {}

  std::vector<RayResult> sample(int threads, const Cancellation& cancellation) const {
    std::vector<RayResult> results(ray_count);
    WorkerThreads workers(thread_count(threads));
    for_each_index(workers, std::size_t{0}, ray_count / rays_in_block, [&](std::size_t block) {
      cancellation.throw_if_canceled();
      for (std::size_t k = block * rays_in_block; k < (block + 1) * rays_in_block; ++k) {
        results[k] = trace(k);
      }
    });
    return results;
  }

 private:
  static std::vector<PatchId> all_patches(const Scene& scene) {
    std::vector<PatchId> patches(scene.patches().size());
    std::iota(patches.begin(), patches.end(), PatchId{0});
    return patches;
  }
  bool is_two_sided(PatchId i) const {
    return are_two_sides(scene_, i) || are_two_sides(scene_, i - 1);
  }
  /// Whether a ray that met nothing came from its patch, and not from behind an edge of a neighbor,
  /// where rounding may place a point. A ray back from outside tells.
  bool starts_outside(PatchId patch, const Vec3& origin, const Vec3& direction) const {
    constexpr double outside = 4;  // the scene has radius 1
    const auto meeting = first_meeting(embree_, origin + outside * direction, -direction);
    return meeting && scene_.patch(meeting->patch).face == scene_.patch(patch).face;
  }

  RayResult trace(std::size_t k) const {
    RandomNumbers random(k);
    const double where = (static_cast<double>(k) + random.next()) / double{ray_count};
    const auto viewer = points_.point(points_.range(0, scene_.patches().size()), where, random);
    const Vec3& normal = scene_.patch(viewer.patch).normal;
    const Vec3 direction = diffuse_direction(normal, random);
    const Vec3 origin = viewer.position + ray_lift * normal;
    const Vec3 behind = viewer.position - ray_lift * normal;
    RayResult ray;
    if (const auto meeting = first_meeting(embree_, origin, direction)) {
      const PatchId lit = embree_.lit_at(meeting->patch, origin, direction, meeting->distance);
      ray.patch = lit == no_patch ? meeting->patch : lit;
      ray.back = lit == no_patch;
    } else if (starts_outside(viewer.patch, origin, direction)) {
      const auto inner = first_meeting(embree_, behind, -direction);
      ray.open = !(inner && is_two_sided(viewer.patch));
      ray.dark_inside =
          inner && embree_.lit_at(inner->patch, behind, -direction, inner->distance) == no_patch;
    }
    return ray;
  }

  const Scene& scene_;
  EmbreeScene embree_;
  SurfacePoints points_;
};

/// Backs and all, of one material or group.
struct Count {
  std::int64_t seen = 0, backs = 0;
};

std::vector<BackCount> shares_of(const std::vector<Count>& counts,
                                 const std::vector<std::string>& names, double all) {
  std::vector<BackCount> shares;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k].backs > 0) {
      const auto backs = static_cast<double>(counts[k].backs);
      shares.push_back({names[k], backs / static_cast<double>(counts[k].seen), backs / all});
    }
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const BackCount& a, const BackCount& b) { return a.of_all > b.of_all; });
  return shares;
}

}  // namespace

BackShare back_share(const Scene& scene, int threads, const Cancellation& cancellation) {
  std::vector<Count> materials(scene.materials().size()), groups(scene.groups().size());
  std::int64_t seen = 0, backs = 0, open = 0, dark = 0;
  for (const RayResult& ray : RaySampler(scene, cancellation).sample(threads, cancellation)) {
    open += ray.open ? 1 : 0;
    dark += ray.dark_inside ? 1 : 0;
    if (ray.patch == no_patch) {
      continue;
    }
    const Patch& patch = scene.patch(ray.patch);
    const auto add = [&](Count& count) {
      ++count.seen;
      count.backs += ray.back ? 1 : 0;
    };
    ++seen;
    backs += ray.back ? 1 : 0;
    add(at(materials, patch.material));
    if (patch.group != no_group) {
      add(at(groups, patch.group));
    }
  }
  std::vector<std::string> names;
  for (const Material& material : scene.materials()) {
    names.push_back(material.name);
  }
  BackShare result;
  result.open = static_cast<double>(open) / double{ray_count};
  const auto all = static_cast<double>(seen);
  if (all < nothing * double{ray_count} && dark > std::int64_t{ray_count} / 2) {
    result.share = 1;
  } else if (seen > 0) {
    result.share = static_cast<double>(backs) / all;
  }
  if (seen > 0) {
    result.materials = shares_of(materials, names, all);
    result.groups = shares_of(groups, scene.groups(), all);
  }
  return result;
}

}  // namespace transillum
