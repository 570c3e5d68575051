// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "model/requests/recorded_map.h"
#include "transillum/scene.h"

namespace transillum::viewer {

/// A text that names something in the scene and in the visibility map.
struct Callout {
  /// The kinds of object that a callout points at.
  enum class Anchor {
    patch,      ///< a patch: its center; in the map its largest visible part
    point,      ///< a point of the scene; in the map its projection
    direction,  ///< the arrow of omega; in the map the direction of view
    map,        ///< V: the whole map, in the map only
    inside      ///< the inside list of the step, in the map only
  };
  std::string text;
  Anchor anchor = Anchor::patch;
  PatchId patch = no_patch;
  Vec3 point;  ///< m
};

/// The point of the visibility map that a callout points at, meters on the plane; for a patch, the
/// middle of its largest polygon. Not set where that is not in the map, or for the whole map and
/// the direction.
/// @param rows  of the map's record: the polygons shown
/// @param step  whose inside list is meant, from 0
std::optional<Vec2> place_in_map(const Callout& callout, const RecordedMap& map,
                                 std::span<const std::int32_t> rows, std::int32_t step);

}  // namespace transillum::viewer
