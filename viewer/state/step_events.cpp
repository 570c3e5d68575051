// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Events of steps, derived from the recorded history of a direction's visibility map.
#include "state/step_events.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "support/number_text.h"

namespace transillum::viewer {

namespace {

using EventKind = StepEvent::Kind;

EventKind kind_of(bool below_front_facing, bool above_front_facing) {
  if (below_front_facing) {
    return above_front_facing ? EventKind::back_seen : EventKind::exchange;
  }
  return above_front_facing ? EventKind::back_to_back : EventKind::back_shown;
}

StepEvent insertion(const MapHistory& history, std::int32_t k) {
  const MapHistory::Step& step = history.step(k);
  const EventKind kind = step.row == MapRecord::no_row ? EventKind::edge_on : EventKind::inserted;
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
    if (event.kind == EventKind::exchange) {
      event.pair_area = exchanged_area(history, event.below, event.above);
    }
    events.push_back(event);
  }
  return events;
}

QString text_of(StepEvent::Kind kind) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("StepEvent", text); };
  switch (kind) {
    case EventKind::edge_on:
      return tr("is edge-on");
    case EventKind::inserted:
      return tr("is inserted into V");
    case EventKind::exchange:
      return tr("receives from");
    case EventKind::back_seen:
      return tr("sees the back side of");
    case EventKind::back_shown:
      return tr("shows its back side to");
    case EventKind::back_to_back:
      return tr("back to back with");
  }
  return {};
}

namespace {

QString tr(const char* text) { return QCoreApplication::translate("EventFilter", text); }

bool involves(const StepEvent& event, PatchId patch) {
  return patch == no_patch || event.below == patch || event.above == patch;
}

QString kinds_text(const EventFilter& filter) {
  const auto count = std::count(filter.kinds.begin(), filter.kinds.end(), true);
  if (count != 1) {
    return tr("%1 of %2 kinds").arg(count).arg(StepEvent::kind_count);
  }
  const auto only = std::find(filter.kinds.begin(), filter.kinds.end(), true);
  return tr("“%1”").arg(text_of(static_cast<StepEvent::Kind>(only - filter.kinds.begin())));
}

QString area_text(const EventFilter& filter) {
  const QString least = number_text(filter.least_area), largest = number_text(filter.largest_area);
  if (std::isinf(filter.largest_area)) {
    return tr("at least %1 m²").arg(least);
  }
  return filter.least_area > 0 ? tr("%1 to %2 m²").arg(least, largest)
                               : tr("at most %1 m²").arg(largest);
}

}  // namespace

bool EventFilter::passes(const StepEvent& event) const {
  return shows(event.kind) && least_area <= event.area && event.area <= largest_area &&
         involves(event, patch);
}

bool EventFilter::passes_at(const MapHistory& history, std::int32_t step, PatchId other) const {
  const auto events = events_of_step(history, step);
  return std::any_of(events.begin(), events.end(), [&](const StepEvent& event) {
    return passes(event) && involves(event, other);
  });
}

QString text_of(const EventFilter& filter) {
  const EventFilter all;
  QStringList parts;
  if (filter.kinds != all.kinds) {
    parts << kinds_text(filter);
  }
  if (filter.least_area != all.least_area || filter.largest_area != all.largest_area) {
    parts << area_text(filter);
  }
  if (filter.patch != no_patch) {
    parts << tr("patch %1").arg(filter.patch);
  }
  return parts.join(QStringLiteral(", "));
}

StepFinder find_where(std::function<bool(const MapHistory&, std::int32_t)> holds) {
  return [holds = std::move(holds)](const MapHistory& history, std::int32_t from, StepOrder order) {
    const std::int32_t by = order == StepOrder::forward ? 1 : -1;
    for (std::int32_t k = from + by; 0 <= k && k < history.step_count(); k += by) {
      if (holds(history, k)) {
        return k;
      }
    }
    return MapHistory::none;
  };
}

StepFinder find_of(StepFinder finder, std::function<bool(const MapHistory&, std::int32_t)> holds) {
  return [finder = std::move(finder), holds = std::move(holds)](
             const MapHistory& history, std::int32_t from, StepOrder order) {
    std::int32_t k = finder(history, from, order);
    while (k != MapHistory::none && !holds(history, k)) {
      k = finder(history, k, order);
    }
    return k;
  };
}

StepFinder find_events_of(PatchId patch) {
  return [patch](const MapHistory& history, std::int32_t from, StepOrder order) {
    return order == StepOrder::forward ? history.next_step_of(patch, from)
                                       : history.previous_step_of(patch, from);
  };
}

StepFinder find_exchanges() {
  return find_where([](const MapHistory& history, std::int32_t step) {
    return history.step(step).exchanges > 0;
  });
}

StepFinder find_exchanges_of(PatchId patch) {
  return find_of(find_events_of(patch), [patch](const MapHistory& history, std::int32_t k) {
    const auto inside = history.inside_at(k);
    const bool own = history.step(k).patch == patch;
    return std::any_of(inside.begin(), inside.end(), [&](std::int32_t r) {
      return (own || history.row(r).patch == patch) && history.exchanges(r);
    });
  });
}

StepFinder find_changes_at(const Vec2& p) {
  return find_where([p](const MapHistory& history, std::int32_t step) {
    const std::int32_t row = history.step(step).row;
    return row != MapRecord::no_row && history.record().covers(history.row(row), p);
  });
}

}  // namespace transillum::viewer
