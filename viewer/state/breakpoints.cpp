// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Conditions on steps of a recorded direction, and the user's list of them.
#include "state/breakpoints.h"

#include <QSettings>
#include <QStringList>
#include <algorithm>
#include <utility>

#include "support/list_change.h"
#include "support/names.h"
#include "support/number_text.h"

namespace transillum::viewer {

namespace {

using Kind = Condition::Kind;

// Names in settings and session files.
constexpr Name<Kind> breakpoint_names[] = {
    {"patch", Kind::patch},
    {"cut", Kind::cut},
    {"pair", Kind::pair},
    {"small-fragment", Kind::small_fragment},
    {"open-receiver", Kind::open_receiver},
    {"large-map", Kind::large_map},
    {"growing-map", Kind::growing_map},
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

bool holds(const Condition& condition, const MapHistory& history, std::int32_t k) {
  const MapHistory::Step& step = history.step(k);
  switch (condition.kind) {
    case Kind::patch:
      return involves(history, k, condition.patch);
    case Kind::cut:
      return involves(history, k, condition.patch) && cuts(history, k, condition.patch);
    case Kind::pair:
      return exchanges_with(history, k, condition.patch, condition.other);
    case Kind::small_fragment:
      return step.row != MapRecord::no_row && step.smallest < condition.value;
    case Kind::open_receiver:
      return step.front_facing && step.open_fraction() > condition.value;
    case Kind::large_map:
      return step.map_size > condition.value;
    case Kind::growing_map: {
      const double before = k > 0 ? history.step(k - 1).map_size : 0;
      return before <= condition.value && step.map_size > condition.value;
    }
  }
  return false;
}

bool holds(const Breakpoint& breakpoint, const MapHistory& history, std::int32_t k) {
  bool all = holds(breakpoint.condition, history, k);
  for (const auto& [alternative, condition] : breakpoint.further) {
    if (alternative && all) {
      return true;
    }
    all = (alternative || all) && holds(condition, history, k);
  }
  return all;
}

QString text_of(const Condition& b) {
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
      return Breakpoints::tr("A receiver's open part is above %1").arg(number_text(b.value));
    case Kind::large_map:
      return Breakpoints::tr("V has more than %1 polygons").arg(number_text(b.value));
    case Kind::growing_map:
      return Breakpoints::tr("V grows beyond %1 polygons").arg(number_text(b.value));
  }
  return {};
}

QString text_of(const Breakpoint& b) {
  QString text = text_of(b.condition);
  for (const auto& [alternative, condition] : b.further) {
    QString more = text_of(condition);
    if (!more.startsWith(QLatin1String("V "))) {
      more[0] = more[0].toLower();
    }
    text += (alternative ? Breakpoints::tr(", or %1") : Breakpoints::tr(" and %1")).arg(more);
  }
  return b.stop_at == 1 ? text
                        : Breakpoints::tr("%1 (stop at hit %2)").arg(text, count_text(b.stop_at));
}

QString text_of_miss(const Breakpoint& breakpoint, const BreakpointHits& hits) {
  if (hits.steps > 0 || breakpoint.further.empty() || hits.conditions.empty()) {
    return {};
  }
  QStringList parts;
  for (std::size_t c = 0; c < hits.conditions.size(); ++c) {
    const Condition& condition =
        c == 0 ? breakpoint.condition : breakpoint.further[c - 1].condition;
    const HitCount& alone = hits.conditions[c];
    parts << (alone.first ? Breakpoints::tr("%1: first in direction %2, step %3; %4 in all")
                                .arg(text_of(condition), count_text(alone.first->direction + 1),
                                     count_text(alone.first->step + 1), count_text(alone.steps))
                          : Breakpoints::tr("%1: never").arg(text_of(condition)));
  }
  return parts.join(QLatin1Char('\n'));
}

const char* name_of(Kind kind) { return name_in_file(breakpoint_names, kind); }

std::optional<Kind> breakpoint_kind(const std::string& name) {
  return value_named(breakpoint_names, name);
}

void Breakpoints::set_list(std::vector<Breakpoint> list) {
  list_ = std::move(list);
  emit changed();
}

void Breakpoints::change(const QString& what, std::vector<Breakpoint> list) {
  change_list(undo_, what, list_, std::move(list),
              [this](const std::vector<Breakpoint>& other) { set_list(other); });
}

void Breakpoints::change(const QString& what, std::size_t k, const Breakpoint& changed) {
  if (changed == list_[k]) {
    return;
  }
  auto list = list_;
  list[k] = changed;
  change(what.arg(text_of(changed)), std::move(list));
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
  Breakpoint changed = list_[k];
  changed.enabled = enabled;
  change(enabled ? tr("enable breakpoint: %1") : tr("disable breakpoint: %1"), k, changed);
}

void Breakpoints::join(std::size_t k, const Breakpoint::Further& further) {
  Breakpoint changed = list_[k];
  changed.further.push_back(further);
  change(tr("change breakpoint: %1"), k, changed);
}

void Breakpoints::remove_last_condition(std::size_t k) {
  Breakpoint changed = list_[k];
  if (!changed.further.empty()) {
    changed.further.pop_back();
    change(tr("change breakpoint: %1"), k, changed);
  }
}

void Breakpoints::set_stop_at(std::size_t k, int hit) {
  Breakpoint changed = list_[k];
  changed.stop_at = hit;
  change(tr("change breakpoint: %1"), k, changed);
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

namespace {

/// Counts the hits of one run, which begins after a step and visits whole directions from then on.
class HitCounter {
 public:
  HitCounter(std::vector<Breakpoint> list, std::shared_ptr<HitCounts> hits,
             std::function<RunPosition()> searched)
      : list_(std::move(list)), hits_(std::move(hits)), searched_(std::move(searched)) {
    hits_->assign(list_.size(), {});
    for (std::size_t b = 0; b < list_.size(); ++b) {
      (*hits_)[b].conditions.resize(1 + list_[b].further.size());
    }
  }

  std::int32_t operator()(const MapHistory& history, std::int32_t from, StepOrder order) {
    const std::int32_t by = order == StepOrder::forward ? 1 : -1;
    std::int32_t end = by > 0 ? history.step_count() : -1;
    const Vec3& omega = history.record().frame.omega;
    if (!begin_) {
      begin_ = {omega, from};
    } else if (omega == begin_->first) {
      // Back in the first direction, the steps beyond the beginning have been counted.
      end = by > 0 ? std::min(end, begin_->second + 1) : std::max(end, begin_->second - 1);
    }
    for (std::int32_t k = from + by; by > 0 ? k < end : k > end; k += by) {
      if (count(history, k)) {
        return k;
      }
    }
    return MapHistory::none;
  }

 private:
  /// Whether a breakpoint stops the run at step k.
  bool count(const MapHistory& history, std::int32_t k) {
    bool stops = false;
    for (std::size_t b = 0; b < list_.size(); ++b) {
      const Breakpoint& breakpoint = list_[b];
      if (!breakpoint.enabled) {
        continue;
      }
      BreakpointHits& found = (*hits_)[b];
      for (std::size_t c = 0; c < found.conditions.size(); ++c) {
        add(holds(c == 0 ? breakpoint.condition : breakpoint.further[c - 1].condition, history, k),
            k, found.conditions[c]);
      }
      if (add(holds(breakpoint, history, k), k, found)) {
        stops = found.steps == breakpoint.stop_at || stops;
      }
    }
    return stops;
  }

  bool add(bool held, std::int32_t k, HitCount& count) const {
    if (held && ++count.steps == 1) {
      count.first = searched_();
      count.first->step = k;
    }
    return held;
  }

  std::vector<Breakpoint> list_;
  std::shared_ptr<HitCounts> hits_;
  std::function<RunPosition()> searched_;
  std::optional<std::pair<Vec3, std::int32_t>> begin_;  ///< direction and step
};

}  // namespace

StepFinder Breakpoints::run_finder(std::shared_ptr<HitCounts> hits,
                                   std::function<RunPosition()> searched) const {
  return HitCounter(list_, std::move(hits), std::move(searched));
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

namespace {

void write(QSettings& settings, const Condition& condition) {
  settings.setValue("kind", name_of(condition.kind));
  settings.setValue("patch", condition.patch);
  settings.setValue("other", condition.other);
  settings.setValue("value", condition.value);
}

/// nullopt if it comes from a later version.
std::optional<Condition> read_condition(const QSettings& settings) {
  const auto kind = breakpoint_kind(settings.value("kind").toString().toStdString());
  if (!kind) {
    return std::nullopt;
  }
  return Condition{*kind, settings.value("patch").toInt(), settings.value("other").toInt(),
                   settings.value("value").toDouble()};
}

void write(QSettings& settings, const Breakpoint& b) {
  write(settings, b.condition);
  settings.setValue("enabled", b.enabled);
  settings.setValue("stop-at", b.stop_at);
  settings.beginWriteArray("further");
  for (std::size_t k = 0; k < b.further.size(); ++k) {
    settings.setArrayIndex(static_cast<int>(k));
    settings.setValue("alternative", b.further[k].alternative);
    write(settings, b.further[k].condition);
  }
  settings.endArray();
}

std::optional<Breakpoint> read_breakpoint(QSettings& settings) {
  const auto first = read_condition(settings);
  if (!first) {
    return std::nullopt;
  }
  Breakpoint breakpoint{*first, settings.value("enabled", true).toBool(), {}, 1};
  breakpoint.stop_at = std::clamp(settings.value("stop-at", 1).toInt(), 1, Breakpoint::most_hits);
  const int count = settings.beginReadArray("further");
  bool known = true;
  for (int k = 0; k < count; ++k) {
    settings.setArrayIndex(k);
    const auto condition = read_condition(settings);
    known = known && condition;
    if (condition) {
      breakpoint.further.push_back({settings.value("alternative").toBool(), *condition});
    }
  }
  settings.endArray();
  return known ? std::optional(breakpoint) : std::nullopt;
}

}  // namespace

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
      write(settings, b);
    }
  }
  settings.endArray();
}

void Breakpoints::load(QSettings& settings) {
  other_lists_.clear();
  const int count = settings.beginReadArray("breakpoints");
  for (int k = 0; k < count; ++k) {
    settings.setArrayIndex(k);
    const std::string scene = settings.value("scene").toString().toStdString();
    const auto breakpoint = read_breakpoint(settings);
    if (breakpoint && !scene.empty()) {
      other_lists_[scene].push_back(*breakpoint);
    }
  }
  settings.endArray();
  set_list(std::move(other_lists_[scene_]));
  other_lists_.erase(scene_);
}

}  // namespace transillum::viewer
