// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Events of steps, derived from the recorded history of a direction's visibility map.
#include "state/step_events.h"

#include <QCoreApplication>
#include <algorithm>
#include <map>

namespace transillum::viewer {

namespace {

using Kind = StepEvent::Kind;

Kind kind_of(bool below_front_facing, bool above_front_facing) {
  if (below_front_facing) {
    return above_front_facing ? Kind::back_seen : Kind::exchange;
  }
  return above_front_facing ? Kind::back_to_back : Kind::back_shown;
}

StepEvent insertion(const MapHistory& history, std::int32_t k) {
  const MapHistory::Step& step = history.step(k);
  const Kind kind = step.row == MapRecord::no_row ? Kind::edge_on : Kind::inserted;
  return {k, kind, step.patch, no_patch, step.area, 0};
}

StepEvent cut_of(const MapHistory& history, std::int32_t inside_row, int parts) {
  const MapRecord::Row& row = history.row(inside_row);
  const MapHistory::Step& step = history.step(row.made);
  return {row.made,
          kind_of(step.front_facing, row.front_facing),
          step.patch,
          row.patch,
          history.record().area(row),
          parts};
}

std::vector<StepEvent> cuts_of(const MapHistory& history, std::int32_t k) {
  std::map<std::int32_t, int> parts;  // by the row that was cut
  for (const std::int32_t r : history.outside_at(k)) {
    ++parts[history.row(r).parent];
  }
  std::vector<StepEvent> events;
  for (const std::int32_t r : history.inside_at(k)) {
    const auto left = parts.find(history.row(r).parent);
    events.push_back(cut_of(history, r, left == parts.end() ? 0 : left->second));
  }
  return events;
}

}  // namespace

std::vector<StepEvent> events_of_step(const MapHistory& history, std::int32_t step) {
  if (step < 0) {
    return {};
  }
  std::vector<StepEvent> events{insertion(history, step)};
  std::vector<StepEvent> cuts = cuts_of(history, step);
  std::stable_sort(cuts.begin(), cuts.end(),
                   [](const StepEvent& a, const StepEvent& b) { return a.area > b.area; });
  events.insert(events.end(), cuts.begin(), cuts.end());
  return events;
}

std::vector<StepEvent> events_of_patch(const MapHistory& history, PatchId patch) {
  std::vector<StepEvent> events;
  for (const std::int32_t k : history.steps_of(patch)) {
    const bool own = history.step(k).patch == patch;
    if (own) {
      events.push_back(insertion(history, k));
    }
    for (const StepEvent& event : cuts_of(history, k)) {
      if (own || event.above == patch) {
        events.push_back(event);
      }
    }
  }
  return events;
}

double exchanged_area(const MapHistory& history, PatchId receiver, PatchId source) {
  double area = 0;
  for (const std::int32_t k : history.steps_of(receiver)) {
    if (history.step(k).patch != receiver) {
      continue;
    }
    for (const std::int32_t r : history.inside_at(k)) {
      if (history.row(r).patch == source && history.exchanges(r)) {
        area += history.record().area(history.row(r));
      }
    }
  }
  return area;
}

std::vector<StepEvent> events_at_point(const MapHistory& history, const Vec2& p) {
  std::vector<StepEvent> events;
  const MapRecord& record = history.record();
  for (std::int32_t k = 0; k < history.step_count(); ++k) {
    const std::int32_t polygon = history.step(k).row;
    if (polygon == MapRecord::no_row || !record.covers(history.row(polygon), p)) {
      continue;
    }
    const auto inside = history.inside_at(k);
    const auto above = std::find_if(inside.begin(), inside.end(), [&](std::int32_t r) {
      return record.covers(history.row(r), p);
    });
    StepEvent event = above == inside.end() ? insertion(history, k) : cut_of(history, *above, 0);
    if (event.kind == Kind::exchange) {
      event.pair_area = exchanged_area(history, event.below, event.above);
    }
    events.push_back(event);
  }
  return events;
}

QString text_of(StepEvent::Kind kind) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("StepEvent", text); };
  switch (kind) {
    case Kind::edge_on:
      return tr("is edge-on");
    case Kind::inserted:
      return tr("is inserted into V");
    case Kind::exchange:
      return tr("receives from");
    case Kind::back_seen:
      return tr("sees the back side of");
    case Kind::back_shown:
      return tr("shows its back side to");
    case Kind::back_to_back:
      return tr("back to back with");
  }
  return {};
}

}  // namespace transillum::viewer
