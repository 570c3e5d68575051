// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <array>
#include <limits>

#include "state/step_events.h"

namespace transillum::viewer {

/// Chooses the events of steps that are listed and stepped to. The default lets all pass.
struct EventFilter {
  double least_area = 0;                                          ///< m²
  double largest_area = std::numeric_limits<double>::infinity();  ///< m²
  PatchId patch = no_patch;                                       ///< below or above; any if
                                                                  ///< no_patch
  std::array<bool, StepEvent::kind_count> kinds = all_kinds();

  static constexpr std::array<bool, StepEvent::kind_count> all_kinds() {
    std::array<bool, StepEvent::kind_count> kinds{};
    kinds.fill(true);
    return kinds;
  }
  bool shows(StepEvent::Kind kind) const { return kinds[static_cast<std::size_t>(kind)]; }
  bool passes(const StepEvent& event) const;
  /// Whether an event of the step passes that involves `patch`, or any event if `patch` is
  /// no_patch.
  bool passes_at(const MapHistory& history, std::int32_t step, PatchId patch = no_patch) const;
  /// Whether the filter can hold back an event.
  bool on() const { return !(*this == EventFilter{}); }

  friend bool operator==(const EventFilter&, const EventFilter&) = default;
};

/// The events that pass, in a few words; empty for a filter that is not on().
QString text_of(const EventFilter& filter);

}  // namespace transillum::viewer
