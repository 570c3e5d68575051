// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "transillum/scene.h"

namespace transillum::viewer {

class JsonObject;

/// Patches first to last.
struct PatchRange {
  PatchId first = 0, last = 0;

  friend bool operator==(const PatchRange&, const PatchRange&) = default;
};

/// Patches as ranges that ascend and have gaps between them.
/// @param patches ascending
std::vector<PatchRange> ranges_of(std::span<const PatchId> patches);
/// The patches of such ranges whose numbers are below `count`, ascending.
std::vector<PatchId> patches_in(std::span<const PatchRange> ranges, PatchId count);

/// Reads a list of patches and of pairs [first, last], ascending; empty without the key.
/// @throws InputError
std::vector<PatchRange> patch_ranges_from_json(JsonObject& object, const std::string& key);
/// The ranges as JSON; null where there are more than a file may have.
nlohmann::json to_json(const std::vector<PatchRange>& ranges);

}  // namespace transillum::viewer
