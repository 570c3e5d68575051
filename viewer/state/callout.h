// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <optional>
#include <string>

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

}  // namespace transillum::viewer
