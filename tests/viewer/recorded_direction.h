// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <memory>
#include <string>

#include "model/snapshot.h"
#include "state/focus.h"
#include "transillum/visibility_map.h"

namespace transillum::viewer::test {

inline std::shared_ptr<const LoadedScene> loaded_with_tree(const std::string& spec) {
  auto result = std::make_shared<LoadedScene>();
  result->scene = load_scene(spec);
  result->tree = std::make_shared<BspTree>(*result->scene);
  return result;
}

/// One direction of a scene, recorded.
struct Direction {
  std::shared_ptr<const LoadedScene> scene;
  Transfers transfers;
  std::shared_ptr<RecordedMap> map = std::make_shared<RecordedMap>();

  explicit Direction(const std::string& spec, const Vec3& along = {0.3, 0.5, 0.8})
      : scene(loaded_with_tree(spec)) {
    RecordedDirection recorded = record_local_map(*scene->scene, *scene->tree, normalized(along));
    transfers = std::move(recorded.transfers);
    map->loaded = scene;
    map->history = MapHistory(std::move(recorded.record));
    map->passes = 1;
  }
  const MapHistory& history() const { return map->history; }
};

/// A focus before the first step of the direction.
struct FocusOn : Focus {
  explicit FocusOn(const Direction& d) {
    begin_run(1);
    go_to({0, 0, -1});
    show_map(d.map);
  }
};

}  // namespace transillum::viewer::test
