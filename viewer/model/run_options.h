// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "options/option_table.h"

namespace transillum::viewer {

/// Whether a solve with the options `in_effect` is the one that `asked` asks for. Directions,
/// replicas and the tolerance may differ if both have the same goal, which chooses them.
bool is_run_of(const SolveOptions& in_effect, const SolveOptions& asked);

/// Reads options from a lesson or session file. Names as on the command line, without dashes;
/// missing options have their defaults. The numbers of threads and bytes depend on the computer and
/// are not included.
/// @throws InputError that begins with `where`
RunOptions run_options_from_json(const nlohmann::json& value, const std::string& where);
/// The JSON of all options that run_options_from_json() reads.
nlohmann::json to_json(const RunOptions& options);

}  // namespace transillum::viewer
