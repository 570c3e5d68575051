// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <vector>

#include "transillum/scene.h"

namespace transillum {

/// A set of emitting patches connected by shared points: a lamp, however many patches it has.
struct LightSource {
  std::vector<PatchId> patches;  ///< ascending
  double area = 0;               ///< m²
  double power = 0;              ///< W, sum of channels
};

/// All light sources, by their first patch.
std::vector<LightSource> light_sources(const Scene& scene);

}  // namespace transillum
