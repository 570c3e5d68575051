// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json.hpp>

#include "transillum/radiosity.h"
#include "transillum/scene.h"

namespace transillum {

/// Options of a solve and of its scene, as in statistics (data/FILES.md). Those not given are null.
nlohmann::ordered_json options_json(const SolveOptions& options, const SceneOptions& scene_options);

}  // namespace transillum
