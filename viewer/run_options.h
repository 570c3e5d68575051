// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "transillum/radiosity.h"
#include "transillum/scene.h"

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

/// A setting of a solve. Declared once: the command line, the panel, lessons, sessions and the list
/// of settings all take it from here.
struct Setting {
  const char* name;      ///< of the command line, without dashes, and of files
  const char* type;      ///< what values it takes
  const char* sentence;  ///< what it does
};
const std::vector<Setting>& settings();
/// @param name of one of them
const char* sentence_of(const std::string& name);

/// Options as lessons and sessions name them: as the command line does, without the dashes. What is
/// missing has its default. Threads and memory are the machine's business, and not among them.
/// @throws InputError that begins with `where`.
RunOptions run_options_from_json(const nlohmann::json& value, const std::string& where);
/// All of settings().
nlohmann::json to_json(const RunOptions& options);

}  // namespace transillum::viewer
