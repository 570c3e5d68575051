// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// What light meets in a scene, by random paths from its sources: how much of it is a back; and how
// much of what lit sides see is nothing, by rays from all of them. Each path has its own random
// numbers; results are counts, so the order of paths does not matter.
#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/for_each_index.h"
#include "radiosity/orientation/surface_rays.h"
#include "scene/build/two_sided.h"
#include "transillum/orientation.h"

namespace transillum {
namespace {

/// Rays from points of all lit sides.
constexpr std::size_t ray_count = 1U << 15, rays_in_block = 1024;

/// A surface that light meets.
struct Hit {
  PatchId patch = no_patch;
  bool back = false;
};
/// Hits of one path, the last of which may be a back.
using Path = boost::container::static_vector<Hit, longest_path>;

class RaySampler {
 public:
  RaySampler(const Scene& scene, int threads, const Cancellation& cancellation)
      : scene_(scene),
        cancellation_(cancellation),
        embree_(scene, cancellation),
        workers_(thread_count(threads)) {}

  /// Rays from points of these patches' lit sides, uniform by area: whether they meet nothing, on
  /// two-sided faces on either side.
  std::vector<char> sample_sides(const std::vector<PatchId>& patches) {
    return sampled<char>(patches, ray_count, rays_in_block, 0,
                         [this](const SurfacePoints::Point& start, RandomNumbers& random) {
                           return is_open_from(start, random);
                         });
  }

  /// Paths of light from points of these patches' lit sides, or of their backs, uniform by area.
  /// They are reflected by lit sides and end at backs.
  std::vector<Path> sample_paths(const std::vector<PatchId>& patches, bool from_backs = false) {
    return sampled<Path>(
        patches, path_count, paths_in_block, ray_count,
        [this, from_backs](const SurfacePoints::Point& start, RandomNumbers& random) {
          const Vec3& normal = scene_.patch(start.patch).normal;
          return path_from(start.position, from_backs ? -normal : normal, random);
        });
  }

 private:
  /// One sample in each of `count` equal fractions of the patches' area.
  template <class Result, class Sample>
  std::vector<Result> sampled(const std::vector<PatchId>& patches, std::size_t count,
                              std::size_t block, std::size_t key, const Sample& sample) {
    const SurfacePoints points(scene_, embree_, patches);
    const auto range = points.range(0, patches.size());
    std::vector<Result> results(count);
    for_each_index(workers_, std::size_t{0}, count / block, [&](std::size_t b) {
      cancellation_.throw_if_canceled();
      for (std::size_t k = b * block; k < (b + 1) * block; ++k) {
        RandomNumbers random(key + k);
        const double where = (static_cast<double>(k) + random.next()) / static_cast<double>(count);
        results[k] = sample(points.point(range, where, random), random);
      }
    });
    return results;
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
  /// The surface that a ray meets: the lit side of one of the patches there, if there is any.
  std::optional<Hit> first_hit(const Vec3& origin, const Vec3& direction, double& distance) const {
    const auto meeting = first_meeting(embree_, origin, direction);
    if (!meeting) {
      return std::nullopt;
    }
    distance = static_cast<double>(meeting->distance);
    const PatchId lit = embree_.lit_at(meeting->patch, origin, direction, meeting->distance);
    return lit == no_patch ? Hit{meeting->patch, true} : Hit{lit, false};
  }

  char is_open_from(const SurfacePoints::Point& start, RandomNumbers& random) const {
    const Vec3& normal = scene_.patch(start.patch).normal;
    const Vec3 direction = diffuse_direction(normal, random);
    const Vec3 origin = start.position + ray_lift * normal;
    double distance = 0;
    if (first_hit(origin, direction, distance) || !starts_outside(start.patch, origin, direction)) {
      return false;
    }
    return !is_two_sided(start.patch) ||
           !first_hit(start.position - ray_lift * normal, -direction, distance);
  }

  Path path_from(Vec3 position, Vec3 normal, RandomNumbers& random) const {
    Path path;
    while (path.size() < longest_path && (path.empty() || !path.back().back)) {
      const Vec3 direction = diffuse_direction(normal, random), from = position + ray_lift * normal;
      double distance = 0;
      const auto hit = first_hit(from, direction, distance);
      if (!hit) {
        break;
      }
      path.push_back(*hit);
      position = from + distance * direction;
      normal = scene_.patch(hit->patch).normal;
    }
    return path;
  }

  const Scene& scene_;
  const Cancellation& cancellation_;
  EmbreeScene embree_;
  WorkerThreads workers_;
};

/// Backs and all, of one material or group.
struct Count {
  std::int64_t seen = 0, backs = 0;
};

std::vector<BackCount> fractions_of(const std::vector<Count>& counts,
                                    const std::vector<std::string>& names, double all) {
  std::vector<BackCount> fractions;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k].backs > 0) {
      const auto backs = static_cast<double>(counts[k].backs);
      fractions.push_back({names[k], backs / static_cast<double>(counts[k].seen), backs / all});
    }
  }
  std::stable_sort(fractions.begin(), fractions.end(),
                   [](const BackCount& a, const BackCount& b) { return a.of_all > b.of_all; });
  return fractions;
}

/// Sums over what light meets.
struct PathCounts {
  std::vector<Count> materials, groups;
  Count all;
  std::int64_t dark = 0;  ///< hits on patches that do not emit

  PathCounts(const Scene& scene, const std::vector<Path>& paths)
      : materials(scene.materials().size()), groups(scene.groups().size()) {
    for (const Path& path : paths) {
      for (const Hit& hit : path) {
        const Patch& patch = scene.patch(hit.patch);
        add(all, hit);
        dark += max_abs(scene.exitance(hit.patch)) == 0 ? 1 : 0;
        add(at(materials, patch.material), hit);
        if (patch.group != no_group) {
          add(at(groups, patch.group), hit);
        }
      }
    }
  }
  static bool is_nothing(std::int64_t hits) {
    return static_cast<double>(hits) < nothing * double{path_count};
  }

 private:
  static void add(Count& count, const Hit& hit) {
    ++count.seen;
    count.backs += hit.back ? 1 : 0;
  }
};

/// Sums over what light meets, and whether the sources emit it out of the scene.
struct Light {
  PathCounts met;
  bool turned_away = false;
};

/// Follows the light of the sources; that of all lit sides if there are none. If the light of the
/// sources meets nothing, but something is behind them, they are turned away, and what their backs
/// see is counted.
Light follow_light(const Scene& scene, const std::vector<PatchId>& all, RaySampler& rays) {
  std::vector<PatchId> sources;
  std::copy_if(all.begin(), all.end(), std::back_inserter(sources),
               [&](PatchId i) { return max_abs(scene.exitance(i)) > 0; });
  for (const bool behind : {false, true}) {
    if (!sources.empty()) {
      PathCounts met(scene, rays.sample_paths(sources, behind));
      // Light that meets only sources, where there are other patches, is shut up in a lamp.
      if (!PathCounts::is_nothing(sources.size() < all.size() ? met.dark : met.all.seen)) {
        return {std::move(met), behind};
      }
    }
  }
  return {{scene, rays.sample_paths(all)}};
}

}  // namespace

BackFraction back_fraction(const Scene& scene, int threads, const Cancellation& cancellation) {
  RaySampler rays(scene, threads, cancellation);
  std::vector<PatchId> patches(scene.patches().size());
  std::iota(patches.begin(), patches.end(), PatchId{0});
  std::int64_t open = 0;
  for (const bool is_open : rays.sample_sides(patches)) {
    open += is_open ? 1 : 0;
  }
  BackFraction result;
  result.open = static_cast<double>(open) / double{ray_count};
  const auto [met, turned_away] = follow_light(scene, patches, rays);
  if (PathCounts::is_nothing(met.all.seen)) {
    return result;
  }
  std::vector<std::string> names;
  for (const Material& material : scene.materials()) {
    names.push_back(material.name);
  }
  const auto all = static_cast<double>(met.all.seen);
  result.fraction = turned_away ? 1 : static_cast<double>(met.all.backs) / all;
  result.materials = fractions_of(met.materials, names, all);
  result.groups = fractions_of(met.groups, scene.groups(), all);
  return result;
}

}  // namespace transillum
