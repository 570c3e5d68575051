// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "transillum/export.h"

namespace TRANSILLUM_API transillum {

struct SolveOptions;

/// A setting of a solve run, described once for all user interfaces: the help of both programs and
/// the viewer's panels, list of settings, lessons and session files.
struct Setting {
  const char* name;           ///< of the option, and in files
  const char* type;           ///< the values it accepts
  const char* description;    ///< what it does; begins in lower case, no full stop
  std::string default_value;  ///< of SolveOptions and SceneOptions, as text
  bool in_files = true;       ///< lessons and sessions store it; false: it depends on the machine,
                              ///< belongs to an engine, or is for the command line only
};

/// All settings of SolveOptions, SceneOptions and EngineOptions.
const std::vector<Setting>& settings();
/// Setting::description of a setting.
/// @throws std::out_of_range where there is no setting `name`
const char* description_of(const std::string& name);
/// The limit of kept form factors where SolveOptions::memory is 0, bytes: a quarter of the
/// machine's memory.
std::uint64_t default_memory_limit();
/// Why a setting changes nothing in any of these solves, as "used only with engine painter"; empty
/// if it has an effect. For front ends, to refuse options that would silently do nothing.
std::string why_unused(const std::string& name, const std::vector<SolveOptions>& solves);

}  // namespace TRANSILLUM_API transillum
