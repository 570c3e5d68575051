// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::testing {

/// A scene made to be nasty, and directions that see it at its worst.
struct RandomScene {
  std::string kind;  ///< what is nasty about it
  SceneDescription description;
  SceneOptions options;
  bool closed = false;  ///< a room round everything, seen from inside
  std::vector<Vec3> directions;
};

/// The same scene of 5 to 60 patches for the same seed, on every machine with the same C library.
/// Kinds take turns with the seed; about a third is scaled by 1e-6 to 1e6. Directions, all unit:
/// an axis or a diagonal, one along an edge of the scene, one in the plane of a face, a random one.
RandomScene random_scene(std::uint64_t seed);

}  // namespace transillum::testing
