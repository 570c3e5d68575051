// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <QString>
#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "visibility/map/map_history.h"

namespace transillum::viewer {

/// An event of a step: its polygon is inserted, or it cuts a polygon of V.
struct StepEvent {
  enum class Kind {
    edge_on,       ///< the polygon is edge-on: not processed
    inserted,      ///< the polygon is inserted into V
    exchange,      ///< below receives from above
    back_seen,     ///< below faces the back of above
    back_shown,    ///< above faces (along -omega) the back of below
    back_to_back,  ///< neither faces the other
  };
  static constexpr int kind_count = 6;
  std::int32_t step = 0;
  Kind kind = Kind::inserted;
  PatchId below = no_patch;  ///< patch of the polygon that the step processes
  PatchId above = no_patch;  ///< patch of the cut polygon; no_patch if none is cut
  double area = 0;           ///< m²: of the polygon, or of the cut part above it
  int parts = 0;             ///< number of parts of the cut polygon that remain in V
  double pair_area = 0;      ///< events_at_point(): A(below, above) of the direction, m²

  friend bool operator==(const StepEvent&, const StepEvent&) = default;
};

/// The events of a step: its polygon first, then the cut parts by decreasing area.
std::vector<StepEvent> events_of_step(const MapHistory& history, std::int32_t step);
/// The events of a direction that involve one patch, in order.
std::vector<StepEvent> events_of_patch(const MapHistory& history, PatchId patch);
/// A(i, j, omega), m²: area of `source` that `receiver` sees, over all steps of the direction.
double exchanged_area(const MapHistory& history, PatchId receiver, PatchId source);
/// The polygons that cover point `p`, in BSP order, each with the polygon above it there.
std::vector<StepEvent> events_at_point(const MapHistory& history, const Vec2& p);

/// A verb phrase without the patches.
QString text_of(StepEvent::Kind kind);

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

enum class StepOrder { forward, backward };

/// Returns the nearest matching step after `from` (backward: before it), or MapHistory::none.
using StepFinder =
    std::function<std::int32_t(const MapHistory& history, std::int32_t from, StepOrder order)>;

/// Finds steps that process, cut or cover a polygon of the patch.
StepFinder find_events_of(PatchId patch);
/// Finds steps in which the patch receives light, or emits it to another patch.
StepFinder find_exchanges_of(PatchId patch);
/// Finds steps whose polygon receives light from polygons above it.
StepFinder find_exchanges();
/// Finds steps whose polygon covers point `p` of the plane.
StepFinder find_changes_at(const Vec2& p);
/// Finds the steps of `finder` for which `holds` returns true.
StepFinder find_of(StepFinder finder,
                   std::function<bool(const MapHistory& history, std::int32_t step)> holds);
/// Finds steps for which `holds` returns true; tests each step.
StepFinder find_where(std::function<bool(const MapHistory& history, std::int32_t step)> holds);

}  // namespace transillum::viewer
