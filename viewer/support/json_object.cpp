// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/json_object.h"

#include <algorithm>
#include <cmath>

namespace transillum::viewer {

using nlohmann::json;

void JsonObject::read(const std::string& key, std::string& value) {
  const json* found = find(key);
  if (!found) {
    return;
  }
  if (!found->is_string()) {
    fail_at(key, "must be a string in quotes");
  }
  value = found->get<std::string>();
}

void JsonObject::read(const std::string& key, bool& value) {
  const json* found = find(key);
  if (!found) {
    return;
  }
  if (!found->is_boolean()) {
    fail_at(key, "must be true or false");
  }
  value = found->get<bool>();
}

void JsonObject::read(const std::string& key, double& value) {
  const json* found = find(key);
  if (!found) {
    return;
  }
  if (!found->is_number()) {
    fail_at(key, "must be a number");
  }
  value = found->get<double>();
}

void JsonObject::read(const std::string& key, int& value, int least, int most) {
  const json* found = find(key);
  if (!found) {
    return;
  }
  const double number = found->is_number() ? found->get<double>() : std::nan("");
  if (!(number >= least && number <= most) || number != std::floor(number)) {
    fail_at(key,
            "must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  value = static_cast<int>(number);
}

void JsonObject::read(const std::string& key, Vec3& value) {
  if (const json* found = find(key)) {
    value = vec3_from_json(*found, where(key));
  }
}

void JsonObject::done() const {
  for (const auto& item : value_.items()) {
    if (known_.count(item.key()) > 0) {
      continue;
    }
    std::string keys;
    for (const std::string& key : known_) {
      keys += (keys.empty() ? "" : ", ") + key;
    }
    fail("unknown key \"" + item.key() + "\"; known keys: " + keys);
  }
}

Vec3 vec3_from_json(const json& value, const std::string& where) {
  const bool numbers =
      value.is_array() && value.size() == 3 &&
      std::all_of(value.begin(), value.end(), [](const json& item) { return item.is_number(); });
  if (!numbers) {
    throw InputError(where + ": must be three numbers [x, y, z]");
  }
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

json to_json(const Vec3& v) { return json::array({v.x, v.y, v.z}); }

json parse_json(const std::string& text, const std::string& name) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw InputError(name + ", line " + std::to_string(line) + ": invalid JSON (see " +
                     "https://www.json.org): check commas, quotes and brackets");
  }
}

}  // namespace transillum::viewer
