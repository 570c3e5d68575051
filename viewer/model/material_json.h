// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <string>
#include <vector>

#include "support/json_object.h"
#include "transillum/material_changes.h"

namespace transillum::viewer {

/// Reads the list of changed materials under `key`; empty if there is none. `name` is a target of
/// change_materials(); at least one of `exitance` and `reflectance` is required.
/// @throws InputError naming the place
std::vector<MaterialChange> material_changes_from_json(JsonObject& object, const char* key);
nlohmann::json to_json(const std::vector<MaterialChange>& changes);

}  // namespace transillum::viewer
