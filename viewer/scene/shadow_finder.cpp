// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/shadow_finder.h"

namespace transillum::viewer {

// While the sun is moved, a late answer is better than none.
ShadowFinder::ShadowFinder(QObject* parent)
    : QObject(parent),
      edges_(
          *this, &find, [this] { emit changed(); }, CurrentJob::finish) {}

void ShadowFinder::request(const SolverSnapshot& snapshot,
                           const std::shared_ptr<const RecordedMap>& map) {
  const Sun& sun = (snapshot.of_file ? snapshot.loaded->stored->sky : snapshot.options.sky).sun;
  Request request{.loaded = snapshot.loaded, .materials = nullptr, .sun = {}, .map = nullptr};
  if (sun.is_set()) {
    request.sun = sun.direction;
  } else if (map && map->loaded == snapshot.loaded) {
    request.map = map;
    request.materials = snapshot.materials;
  } else {
    return;  // while an object is moved, its map follows
  }
  if (loaded_ != snapshot.loaded) {
    edges_.clear();
    loaded_ = snapshot.loaded;
  }
  edges_.request(request);
}

const std::vector<ShadowEdge>* ShadowFinder::edges(const LoadedScene& loaded) const {
  const auto found = edges_.result();
  return found && found->loaded.get() == &loaded ? &found->edges : nullptr;
}

ShadowFinder::Found ShadowFinder::find(const Request& request, const Cancellation& cancellation) {
  const Scene& scene = *request.loaded->scene;
  const BspTree& tree = *request.loaded->tree;
  Found found{request.loaded, {}};
  if (request.sun) {
    found.edges = shadow_edges(scene, tree,
                               record_local_map(scene, tree, -*request.sun, cancellation).record);
  } else if (request.map) {
    std::vector<bool> emits;
    for (PatchId i = 0; i < scene.patch_count(); ++i) {
      const Material& material = request.materials ? request.materials->of(i) : scene.material(i);
      emits.push_back(max_abs(material.exitance) > 0);
    }
    found.edges = lamp_shadow_edges(scene, tree, request.map->record(), emits);
  }
  return found;
}

}  // namespace transillum::viewer
