// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "model/recorded_map.h"
#include "state/callout.h"

namespace transillum::viewer {

/// The point of the visibility map that a callout points at, meters on the plane; for a patch, the
/// middle of its largest polygon. Not set where that is not in the map, or for the whole map and
/// the direction.
/// @param rows  of the map's record: the polygons shown
/// @param step  whose inside list is meant, from 0
std::optional<Vec2> place_in_map(const Callout& callout, const RecordedMap& map,
                                 std::span<const std::int32_t> rows, std::int32_t step);

}  // namespace transillum::viewer
