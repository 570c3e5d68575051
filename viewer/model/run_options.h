// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "transillum/radiosity.h"
#include "transillum/scene.h"
#include "transillum/settings.h"

namespace transillum::viewer {

/// All that a solve is told.
struct RunOptions {
  SolveOptions solve;
  SceneOptions scene;

  friend bool operator==(const RunOptions& a, const RunOptions& b) {
    return a.solve == b.solve && a.scene.two_sided == b.scene.two_sided &&
           a.scene.max_patch_area == b.scene.max_patch_area;
  }
};

/// Options as lessons and sessions name them: as the command line does, without the dashes. What is
/// missing has its default. Threads and memory are the machine's business, and not among them.
/// @throws InputError that begins with `where`.
RunOptions run_options_from_json(const nlohmann::json& value, const std::string& where);
/// All settings() that files name.
nlohmann::json to_json(const RunOptions& options);

}  // namespace transillum::viewer
