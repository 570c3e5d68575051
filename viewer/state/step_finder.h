// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <functional>

#include "transillum/map_history.h"

namespace transillum::viewer {

enum class StepOrder { forward, backward };

/// The nearest step after `from` (before it) of what is looked for, or MapHistory::none.
using StepFinder =
    std::function<std::int32_t(const MapHistory& history, std::int32_t from, StepOrder order)>;

/// Steps that process, cut or cover a polygon of the patch.
StepFinder find_events_of(PatchId patch);
/// Steps at which the patch receives or gives light.
StepFinder find_exchanges_of(PatchId patch);
/// Steps whose polygon exchanges light with what lies above it.
StepFinder find_exchanges();
/// Steps that put something else on top at point `p` of the plane, seen from below.
StepFinder find_changes_at(const Vec2& p);
/// Steps of which `holds` is true, one by one.
StepFinder find_where(std::function<bool(const MapHistory& history, std::int32_t step)> holds);

}  // namespace transillum::viewer
