// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

namespace transillum {

/// A setting of a solve, for whatever shows or asks for it. Told once: both programs' help, the
/// viewer's panels, its list of settings, lessons and sessions take it from here.
struct Setting {
  const char* name;           ///< of the command line, without dashes, and of files
  const char* type;           ///< what values it takes
  const char* description;    ///< what it does; small letters first, no full stop
  std::string default_value;  ///< of SolveOptions and SceneOptions, as text
  bool in_files = true;       ///< lessons and sessions name it; else the machine's or an engine's
};

/// All of SolveOptions, SceneOptions and EngineOptions.
const std::vector<Setting>& settings();
/// @throws std::out_of_range where there is no setting `name`
const char* description_of(const std::string& name);

}  // namespace transillum
