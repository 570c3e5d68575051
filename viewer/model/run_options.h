// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Options of a run and changes of materials, to and from JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "options/option_table.h"
#include "support/json_object.h"
#include "transillum/material_changes.h"

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

/// Reads the list of changed materials under `key`; empty if there is none. `name` is a target of
/// change_materials(); at least one of `exitance` and `reflectance` is required.
/// @throws InputError naming the place
std::vector<MaterialChange> material_changes_from_json(JsonObject& object, const char* key);
nlohmann::json to_json(const std::vector<MaterialChange>& changes);

}  // namespace transillum::viewer
