// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>

#include "support/random_scenes.h"
#include "transillum/scene.h"

namespace transillum::testing {

enum class Imperfect {
  rails,    ///< sleepers and two rails, which touch, float or are sunk
  beams,    ///< long thin boxes in random directions
  truss,    ///< long thin triangles that share end points, both sides
  clutter,  ///< boxes that interpenetrate one another and the floor
  ball,     ///< a sphere on the floor, touching it in one point
  terrain   ///< bent quadrilaterals with random heights
};

/// A scene as files have them: turned, rounded, touching or interpenetrating, in a closed room
/// whose ceiling emits.
struct ImperfectScene {
  Imperfect kind = Imperfect::rails;
  int count = 10;        ///< objects; of a ball, rings; of a terrain, quadrilaterals along an edge
  double gap = 0;        ///< gap of rails, m
  double aspect = 5000;  ///< aspect of beams, and the largest of a truss
  int digits = 17;       ///< significant digits of coordinates
  bool turned = false;   ///< by a random rotation
  bool quads = false;    ///< else triangles
  std::uint64_t seed = 1;
};
SceneDescription describe(const ImperfectScene& scene);

/// A small scene of a random kind, and directions: two random ones and an axis, along which edges
/// run in scenes that are not turned. About a fifth has all 17 digits, the others 6 to 12.
RandomScene random_imperfect_scene(std::uint64_t seed);

}  // namespace transillum::testing
