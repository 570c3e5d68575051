// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "lessons/patch_ranges.h"

#include <algorithm>

#include "support/json_object.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

constexpr std::size_t most_ranges = 100'000;
constexpr double largest_patch = 1 << 30;

bool is_patch(const json& value) {
  return value.is_number_integer() && value.get<double>() >= 0 &&
         value.get<double>() <= largest_patch;
}

PatchRange range_from(const json& value, const std::string& where) {
  if (is_patch(value)) {
    return {value.get<PatchId>(), value.get<PatchId>()};
  }
  if (value.is_array() && value.size() == 2 && is_patch(value[0]) && is_patch(value[1])) {
    return {value[0].get<PatchId>(), value[1].get<PatchId>()};
  }
  throw InputError(where + ": must be a patch, or a pair of patches [first, last]");
}

}  // namespace

std::vector<PatchRange> ranges_of(std::span<const PatchId> patches) {
  std::vector<PatchRange> ranges;
  for (const PatchId patch : patches) {
    if (!ranges.empty() && ranges.back().last + 1 == patch) {
      ranges.back().last = patch;
    } else {
      ranges.push_back({patch, patch});
    }
  }
  return ranges;
}

std::vector<PatchId> patches_in(std::span<const PatchRange> ranges, PatchId count) {
  std::vector<PatchId> patches;
  for (const PatchRange& range : ranges) {
    for (PatchId patch = range.first; patch <= std::min(range.last, count - 1); ++patch) {
      patches.push_back(patch);
    }
  }
  return patches;
}

std::vector<PatchRange> patch_ranges_from_json(JsonObject& object, const std::string& key) {
  const json* list = object.find(key);
  if (!list) {
    return {};
  }
  if (!list->is_array()) {
    object.fail_at(key, "must be a list of patches and pairs of patches [3, [7, 12], …]");
  }
  if (list->size() > most_ranges) {
    object.fail_at(key, "must be a list of at most " + std::to_string(most_ranges));
  }
  std::vector<PatchRange> ranges;
  for (const json& value : *list) {
    const std::string where = object.where(key) + ", item " + std::to_string(ranges.size() + 1);
    const PatchRange range = range_from(value, where);
    if (range.last < range.first || (!ranges.empty() && range.first <= ranges.back().last)) {
      throw InputError(where + ": patches must ascend");
    }
    ranges.push_back(range);
  }
  return ranges;
}

json to_json(const std::vector<PatchRange>& ranges) {
  if (ranges.size() > most_ranges) {
    return nullptr;
  }
  json list = json::array();
  for (const PatchRange& range : ranges) {
    list.push_back(range.first == range.last ? json(range.first)
                                             : json::array({range.first, range.last}));
  }
  return list;
}

}  // namespace transillum::viewer
