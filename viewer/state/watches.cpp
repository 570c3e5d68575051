// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/watches.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "support/list_change.h"
#include "support/names.h"
#include "transillum/at.h"

namespace transillum::viewer {

namespace {

// Names in session files.
constexpr Name<Watch::Kind> watch_names[] = {
    {"patch-area", Watch::Kind::patch_area},
    {"closure-defect", Watch::Kind::closure_defect},
    {"map-size", Watch::Kind::map_size},
};

std::vector<double> areas_of(PatchId patch, const MapHistory& history) {
  std::vector<double> areas(static_cast<std::size_t>(history.step_count()) + 1, 0);
  for (const MapRecord::Row& row : history.record().rows) {
    if (row.patch != patch || row.made == row.consumed) {
      continue;
    }
    const double area = history.record().area(row);
    const std::int32_t end = std::min(row.consumed, history.step_count());
    for (std::int32_t k = row.made; k < end; ++k) {
      at(areas, k + 1) += area;
    }
  }
  return areas;
}

}  // namespace

std::vector<double> values_of(const Watch& watch, const MapHistory& history) {
  if (watch.kind == Watch::Kind::patch_area) {
    return areas_of(watch.patch, history);
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values{watch.kind == Watch::Kind::map_size ? 0 : none};
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    const MapHistory::Step& step = history.step(k);
    if (watch.kind == Watch::Kind::map_size) {
      values.push_back(step.map_size);
    } else {
      values.push_back(step.front_facing ? step.open_fraction() : none);
    }
  }
  return values;
}

QString text_of(const Watch& watch) {
  switch (watch.kind) {
    case Watch::Kind::patch_area:
      return Watches::tr("Area of patch %1 in V, m²").arg(watch.patch);
    case Watch::Kind::closure_defect:
      return Watches::tr("Open part");
    case Watch::Kind::map_size:
      return Watches::tr("Polygons of V");
  }
  return {};
}

const char* name_of(Watch::Kind kind) { return name_in_file(watch_names, kind); }

std::optional<Watch::Kind> watch_kind(const std::string& name) {
  return value_named(watch_names, name);
}

void Watches::set_list(std::vector<Watch> list) {
  list_ = std::move(list);
  emit changed();
}

void Watches::set_scene(const std::string& scene) {
  if (scene == scene_) {
    return;
  }
  scene_ = scene;
  set_list(scene == next_scene_ ? std::exchange(next_list_, {}) : std::vector<Watch>());
}

void Watches::set_list_of(const std::string& scene, std::vector<Watch> list) {
  if (scene == scene_) {
    set_list(std::move(list));
  } else {
    next_scene_ = scene;
    next_list_ = std::move(list);
  }
}

void Watches::change(const QString& what, std::vector<Watch> list) {
  change_list(undo_, what, list_, std::move(list),
              [this](const std::vector<Watch>& other) { set_list(other); });
}

void Watches::add(const Watch& watch) {
  const bool known = std::find(list_.begin(), list_.end(), watch) != list_.end();
  if (known || list_.size() >= most) {
    return;
  }
  auto list = list_;
  list.push_back(watch);
  change(tr("watch: %1").arg(text_of(watch)), std::move(list));
}

void Watches::remove(std::size_t k) {
  auto list = list_;
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(k));
  change(tr("remove watch: %1").arg(text_of(list_[k])), std::move(list));
}

}  // namespace transillum::viewer
