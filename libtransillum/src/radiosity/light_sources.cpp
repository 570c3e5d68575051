// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "radiosity/light_sources.h"

#include <map>
#include <numeric>

namespace transillum {
namespace {

double power(const Scene& scene, PatchId i) {
  const Rgb& exitance = scene.exitance(i);
  return scene.patch(i).area * (exitance.r + exitance.g + exitance.b);
}

/// Finds connected sources (union-find): root() is the same point for all points of the emitting
/// patches of one source.
class SourceNumbers {
 public:
  explicit SourceNumbers(const Scene& scene) : parents_(scene.points().size()) {
    std::iota(parents_.begin(), parents_.end(), PointId{0});
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      if (power(scene, i) == 0) {
        continue;
      }
      const auto outline = scene.outline(i);
      for (const PointId p : outline) {
        parents_[index(root(p))] = root(outline.front());
      }
    }
  }

  PointId root(PointId p) {
    while (parents_[index(p)] != p) {
      PointId& parent = parents_[index(p)];
      p = parent = parents_[index(parent)];
    }
    return p;
  }

 private:
  static std::size_t index(PointId p) { return static_cast<std::size_t>(p); }

  std::vector<PointId> parents_;
};

}  // namespace

std::vector<LightSource> light_sources(const Scene& scene) {
  SourceNumbers numbers(scene);
  std::map<PointId, std::size_t> places;
  std::vector<LightSource> sources;
  for (PatchId i = 0; i < scene.patch_count(); ++i) {
    if (power(scene, i) == 0) {
      continue;
    }
    const auto [place, is_new] =
        places.try_emplace(numbers.root(scene.outline(i).front()), sources.size());
    if (is_new) {
      sources.emplace_back();
    }
    LightSource& source = sources[place->second];
    source.patches.push_back(i);
    source.area += scene.patch(i).area;
    source.power += power(scene, i);
  }
  return sources;
}

}  // namespace transillum
