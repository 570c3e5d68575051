// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::testing {

/// A scene with degeneracies, and directions along which they matter most.
struct RandomScene {
  std::string kind;  ///< which degeneracy
  SceneDescription description;
  SceneOptions options;
  bool closed = false;  ///< everything is inside a room
  std::vector<Vec3> directions;
};

/// A random scene of 5 to 60 patches; the same for the same seed on every machine with the same C
/// library. The kind is the seed modulo the number of kinds; about a third of the scenes is scaled
/// by 1e-6 to 1e6. Directions, all unit: an axis or a diagonal, one along an edge of the scene, one
/// in the plane of a face, a random one.
RandomScene random_scene(std::uint64_t seed);

}  // namespace transillum::testing
