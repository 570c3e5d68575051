// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

#include "visibility/map/map_history.h"

namespace transillum::viewer {

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
