// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "state/step_finder.h"

#include <algorithm>
#include <utility>

namespace transillum::viewer {

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
