// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json.hpp>

#include "io/runs/sealed_file.h"
#include "transillum/scene.h"
#include "transillum/solve_options.h"

namespace transillum {

/// Data that two runs must have in common to have the same bits.
struct RunIdentity {
  nlohmann::ordered_json json;  ///< version, scene, and the options that results depend on
  /// The scene as files name it that were written before XXH3 was used.
  nlohmann::ordered_json former_scene;
};
RunIdentity run_identity(const Scene& scene, const SolveOptions& options);

/// The options that results depend on: not memory and threads.
nlohmann::ordered_json run_options(const SolveOptions& options, const SceneOptions& scene_options);

/// Compares the identity in a file's head with the identity of this run.
/// @throws InputError naming the first difference
void check_identity(const SealedFile& file, const RunIdentity& expected);

}  // namespace transillum
