// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Conditions on steps of a recorded direction, and the user's list of them.
#include "state/breakpoints.h"

#include <QSettings>
#include <algorithm>
#include <utility>

#include "support/list_change.h"
#include "support/number_text.h"

namespace transillum::viewer {

namespace {

using Kind = Breakpoint::Kind;

// Names in settings and session files.
constexpr std::pair<Kind, const char*> kind_names[] = {
    {Kind::patch, "patch"},
    {Kind::cut, "cut"},
    {Kind::pair, "pair"},
    {Kind::small_fragment, "small-fragment"},
    {Kind::open_receiver, "open-receiver"},
    {Kind::large_map, "large-map"},
};

bool exchanges_with(const MapHistory& history, std::int32_t k, PatchId one, PatchId other) {
  const PatchId receiver = history.step(k).patch;
  if (receiver != one && receiver != other) {
    return false;
  }
  const PatchId source = receiver == one ? other : one;
  const auto inside = history.inside_at(k);
  return std::any_of(inside.begin(), inside.end(), [&](std::int32_t r) {
    return history.row(r).patch == source && history.exchanges(r);
  });
}

bool cuts(const MapHistory& history, std::int32_t k, PatchId patch) {
  const auto inside = history.inside_at(k);
  return std::any_of(inside.begin(), inside.end(),
                     [&](std::int32_t r) { return history.row(r).patch == patch; });
}

bool involves(const MapHistory& history, std::int32_t k, PatchId patch) {
  const auto steps = history.steps_of(patch);
  return std::binary_search(steps.begin(), steps.end(), k);
}

}  // namespace

bool holds(const Breakpoint& breakpoint, const MapHistory& history, std::int32_t k) {
  const MapHistory::Step& step = history.step(k);
  switch (breakpoint.kind) {
    case Kind::patch:
      return involves(history, k, breakpoint.patch);
    case Kind::cut:
      return involves(history, k, breakpoint.patch) && cuts(history, k, breakpoint.patch);
    case Kind::pair:
      return exchanges_with(history, k, breakpoint.patch, breakpoint.other);
    case Kind::small_fragment:
      return step.row != MapRecord::no_row && step.smallest < breakpoint.value;
    case Kind::open_receiver:
      return step.front_facing && step.open_share() > breakpoint.value;
    case Kind::large_map: {
      const double before = k > 0 ? history.step(k - 1).map_size : 0;
      return before <= breakpoint.value && step.map_size > breakpoint.value;
    }
  }
  return false;
}

QString text_of(const Breakpoint& b) {
  switch (b.kind) {
    case Kind::patch:
      return Breakpoints::tr("Patch %1 takes part").arg(b.patch);
    case Kind::cut:
      return Breakpoints::tr("Patch %1 is cut").arg(b.patch);
    case Kind::pair:
      return Breakpoints::tr("Patches %1 and %2 exchange light").arg(b.patch).arg(b.other);
    case Kind::small_fragment:
      return Breakpoints::tr("A polygon of V is smaller than %1 m²").arg(number_text(b.value));
    case Kind::open_receiver:
      return Breakpoints::tr("A receiver's closure defect is above %1").arg(number_text(b.value));
    case Kind::large_map:
      return Breakpoints::tr("V grows beyond %1 polygons").arg(number_text(b.value));
  }
  return {};
}

const char* name_of(Kind kind) {
  return std::find_if(std::begin(kind_names), std::end(kind_names),
                      [kind](const auto& name) { return name.first == kind; })
      ->second;
}

std::optional<Kind> breakpoint_kind(const std::string& name) {
  for (const auto& [kind, known] : kind_names) {
    if (name == known) {
      return kind;
    }
  }
  return std::nullopt;
}

void Breakpoints::set_list(std::vector<Breakpoint> list) {
  list_ = std::move(list);
  emit changed();
}

void Breakpoints::change(const QString& what, std::vector<Breakpoint> list) {
  change_list(undo_, what, list_, std::move(list),
              [this](const std::vector<Breakpoint>& other) { set_list(other); });
}

void Breakpoints::add(const Breakpoint& breakpoint) {
  auto list = list_;
  list.push_back(breakpoint);
  change(tr("add breakpoint: %1").arg(text_of(breakpoint)), std::move(list));
}

void Breakpoints::remove(std::size_t k) {
  auto list = list_;
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(k));
  change(tr("remove breakpoint: %1").arg(text_of(list_[k])), std::move(list));
}

void Breakpoints::set_enabled(std::size_t k, bool enabled) {
  if (list_[k].enabled == enabled) {
    return;
  }
  auto list = list_;
  list[k].enabled = enabled;
  change(
      (enabled ? tr("enable breakpoint: %1") : tr("disable breakpoint: %1")).arg(text_of(list_[k])),
      std::move(list));
}

bool Breakpoints::any_enabled() const {
  return std::any_of(list_.begin(), list_.end(), [](const Breakpoint& b) { return b.enabled; });
}

StepFinder Breakpoints::finder() const {
  return find_where([list = list_](const MapHistory& history, std::int32_t k) {
    return std::any_of(list.begin(), list.end(),
                       [&](const Breakpoint& b) { return b.enabled && holds(b, history, k); });
  });
}

std::vector<std::int32_t> Breakpoints::steps_in(const MapHistory& history) const {
  std::vector<std::int32_t> steps;
  const StepFinder next = finder();
  for (std::int32_t k = next(history, -1, StepOrder::forward); k != MapHistory::none;
       k = next(history, k, StepOrder::forward)) {
    steps.push_back(k);
  }
  return steps;
}

void Breakpoints::set_scene(const std::string& scene) {
  if (scene == scene_) {
    return;
  }
  other_lists_[scene_] = std::move(list_);
  scene_ = scene;
  set_list(std::move(other_lists_[scene_]));
  other_lists_.erase(scene_);
}

void Breakpoints::set_list_of(const std::string& scene, std::vector<Breakpoint> list) {
  if (scene == scene_) {
    set_list(std::move(list));
  } else {
    other_lists_[scene] = std::move(list);
  }
}

void Breakpoints::save(QSettings& settings) const {
  auto lists = other_lists_;
  lists[scene_] = list_;
  lists.erase(std::string());
  settings.remove("breakpoints");
  settings.beginWriteArray("breakpoints");
  int index = 0;
  for (const auto& [scene, list] : lists) {
    for (const Breakpoint& b : list) {
      settings.setArrayIndex(index++);
      settings.setValue("scene", QString::fromStdString(scene));
      settings.setValue("kind", name_of(b.kind));
      settings.setValue("patch", b.patch);
      settings.setValue("other", b.other);
      settings.setValue("value", b.value);
      settings.setValue("enabled", b.enabled);
    }
  }
  settings.endArray();
}

void Breakpoints::load(QSettings& settings) {
  other_lists_.clear();
  const int count = settings.beginReadArray("breakpoints");
  for (int k = 0; k < count; ++k) {
    settings.setArrayIndex(k);
    const auto kind = breakpoint_kind(settings.value("kind").toString().toStdString());
    const std::string scene = settings.value("scene").toString().toStdString();
    if (!kind || scene.empty()) {
      continue;
    }
    other_lists_[scene].push_back(
        {*kind, settings.value("patch").toInt(), settings.value("other").toInt(),
         settings.value("value").toDouble(), settings.value("enabled", true).toBool()});
  }
  settings.endArray();
  set_list(std::move(other_lists_[scene_]));
  other_lists_.erase(scene_);
}

}  // namespace transillum::viewer
