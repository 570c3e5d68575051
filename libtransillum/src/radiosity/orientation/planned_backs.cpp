// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Random paths of light in a scene of which a plan says which sides are lit. Input: the scene with
// one patch for each face, its connected components and the sides. Each path has its own random
// numbers; results are counts, so the order of paths does not matter.
#include "radiosity/orientation/planned_backs.h"

#include <boost/container/static_vector.hpp>

#include "base/for_each_index.h"
#include "radiosity/orientation/surface_rays.h"
#include "transillum/at.h"

namespace transillum {
namespace {

/// A surface that light meets.
struct PlannedHit {
  std::int32_t component;
  bool back;
};
/// One path: the component where it begins, and its hits, the last of which may be a back.
struct PlannedPath {
  std::int32_t start = ConnectedComponents::none;
  boost::container::static_vector<PlannedHit, longest_path> hits;
};

class PathTracer {
 public:
  PathTracer(const Scene& scene, const EmbreeScene& embree, const ConnectedComponents& components,
             const std::vector<LitSides>& lit)
      : scene_(scene),
        embree_(embree),
        components_(components),
        of_patch_(lit),
        there_(lit.size(), {false, false}),
        has_light_(scene.has_light()) {
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const PatchId first = at(components.first, i);
      const LitSides sides = at(lit, i);
      const bool same = dot(scene.patch(i).normal, scene.patch(first).normal) > 0;
      LitSides& there = at(there_, first);
      there.front = there.front || (same ? sides.front : sides.back);
      there.back = there.back || (same ? sides.back : sides.front);
    }
  }

  std::vector<PlannedPath> trace(int threads, const Cancellation& cancellation) const {
    const std::vector<PatchId> starts = start_patches();
    const SurfacePoints points(scene_, embree_, starts);
    const auto range = points.range(0, starts.size());
    std::vector<PlannedPath> paths(path_count);
    WorkerThreads workers(thread_count(threads));
    for_each_index(workers, std::size_t{0}, path_count / paths_in_block, [&](std::size_t block) {
      cancellation.throw_if_canceled();
      for (std::size_t k = block * paths_in_block; k < (block + 1) * paths_in_block; ++k) {
        RandomNumbers random(k);
        const double where =
            (static_cast<double>(k) + random.next()) / static_cast<double>(path_count);
        paths[k] = path_from(points.point(range, where, random), random);
      }
    });
    return paths;
  }

 private:
  /// The sources, else all patches; those that are lit on both sides twice.
  std::vector<PatchId> start_patches() const {
    std::vector<PatchId> starts;
    for (PatchId i = 0; i < scene_.patch_count(); ++i) {
      if (has_light_ ? max_abs(scene_.exitance(i)) > 0 : at(components_.first, i) == i) {
        const LitSides sides = start_sides(i);
        starts.insert(starts.end(), (sides.front ? 1U : 0U) + (sides.back ? 1U : 0U), i);
      }
    }
    return starts;
  }
  LitSides start_sides(PatchId i) const { return has_light_ ? at(of_patch_, i) : at(there_, i); }

  PlannedPath path_from(const SurfacePoints::Point& start, RandomNumbers& random) const {
    const LitSides sides = start_sides(start.patch);
    const bool front = sides.front && (!sides.back || random.next() < 0.5);
    PlannedPath path;
    path.start = at(components_.component, at(components_.first, start.patch));
    Vec3 position = start.position;
    Vec3 normal = front ? scene_.patch(start.patch).normal : -scene_.patch(start.patch).normal;
    while (path.hits.size() < longest_path && (path.hits.empty() || !path.hits.back().back)) {
      const Vec3 direction = diffuse_direction(normal, random), from = position + ray_lift * normal;
      const auto meeting = first_meeting(embree_, from, direction);
      if (!meeting) {
        break;
      }
      const PatchId first = at(components_.first, meeting->patch);
      const Vec3& outward = scene_.patch(first).normal;
      const bool meets_front = dot(outward, direction) < 0;
      path.hits.push_back({at(components_.component, first),
                           meets_front ? !at(there_, first).front : !at(there_, first).back});
      normal = meets_front ? outward : -outward;
      position = from + static_cast<double>(meeting->distance) * direction;
    }
    return path;
  }

  const Scene& scene_;
  const EmbreeScene& embree_;
  const ConnectedComponents& components_;
  const std::vector<LitSides>& of_patch_;
  std::vector<LitSides> there_;  ///< by the first patch on the same points: of all patches there
  bool has_light_;
};

}  // namespace

PlannedBacks measure_planned_backs(const Scene& scene, const EmbreeScene& embree,
                                   const ConnectedComponents& components,
                                   const std::vector<LitSides>& lit, int threads,
                                   const Cancellation& cancellation) {
  const bool has_light = scene.has_light();
  PlannedBacks found;
  found.own.resize(components.components.size());
  found.others.resize(components.components.size());
  found.starts.resize(components.components.size());
  for (const PlannedPath& path :
       PathTracer(scene, embree, components, lit).trace(threads, cancellation)) {
    if (path.start != ConnectedComponents::none) {
      ++at(found.starts, path.start);
    }
    for (const PlannedHit& hit : path.hits) {
      found.all.add(hit.back);
      if (hit.component != ConnectedComponents::none) {
        at(found.own, hit.component).add(hit.back);
      }
      if (!has_light && path.start != ConnectedComponents::none && hit.component != path.start) {
        at(found.others, path.start).add(hit.back);
      }
    }
  }
  found.is_known = static_cast<double>(found.all.met) >= nothing * double{path_count};
  return found;
}

}  // namespace transillum
