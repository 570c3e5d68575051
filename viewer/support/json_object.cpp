// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "support/json_object.h"

#include <QString>
#include <algorithm>
#include <cmath>

#include "base/json_text.h"

namespace transillum::viewer {

using nlohmann::json;

namespace {

template <class Value>
void read_if(JsonObject& object, const std::string& key, Value& value,
             bool (json::*is_valid)() const, const char* wanted) {
  if (const json* found = object.find(key)) {
    if (!(found->*is_valid)()) {
      object.fail_at(key, wanted);
    }
    value = found->get<Value>();
  }
}

}  // namespace

void JsonObject::read(const std::string& key, std::string& value) {
  read_if(*this, key, value, &json::is_string, "must be a string in quotes");
}

void JsonObject::read(const std::string& key, bool& value) {
  read_if(*this, key, value, &json::is_boolean, "must be true or false");
}

void JsonObject::read(const std::string& key, double& value) {
  read_if(*this, key, value, &json::is_number, "must be a number");
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
    fail("unknown key " + in_quotes(item.key()) + "; known keys: " + keys);
  }
}

std::string in_quotes(const std::string& text) {
  constexpr int longest = 40;
  QString shown = QString::fromStdString(text);
  for (QChar& c : shown) {
    c = c.isPrint() || c.isSurrogate() ? c : QLatin1Char('?');
  }
  if (shown.size() > longest) {
    shown = shown.left(longest - 1) + QChar(0x2026);
  }
  return '"' + shown.toStdString() + '"';
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
  check_json(text, name);
  return json::parse(text);
}

}  // namespace transillum::viewer
