// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
//
// Values of options as JSON, by way of their text.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "options/option_table.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

using Json = nlohmann::json;

bool is_number(const std::string& text) {
  return Json::accept(text) && Json::parse(text).is_number();
}

/// The text that stands for a value; nothing if an option does not take its type.
std::optional<std::string> text_of(const Option& o, const Json& value) {
  const bool takes_numbers = o.json == Option::Json::number || o.json == Option::Json::numbers;
  if (value.is_null() && !o.unset.empty()) {
    return o.unset;
  }
  if (value.is_boolean() && o.json == Option::Json::flag) {
    return value.get<bool>() ? "yes" : "no";
  }
  if (value.is_number() && takes_numbers) {
    return value.dump();
  }
  if (value.is_string() && o.json != Option::Json::flag) {
    const auto text = value.get<std::string>();
    // "1%" and "auto" are texts, "64" is a number in quotes.
    return takes_numbers && is_number(text) ? std::nullopt : std::optional(text);
  }
  if (value.is_array() && o.json == Option::Json::numbers &&
      std::all_of(value.begin(), value.end(), [](const Json& v) { return v.is_number(); })) {
    std::string text;
    for (const Json& number : value) {
      text += (text.empty() ? "" : ",") + number.dump();
    }
    return text;
  }
  return {};
}

}  // namespace

std::string Option::to_json(const RunOptions& options) const {
  const std::string text = print(options);
  if (!unset.empty() && text == unset) {
    return "null";
  }
  switch (json) {
    case Json::flag:
      return text == "yes" ? "true" : "false";
    case Json::number:
      return is_number(text) ? text : nlohmann::json(text).dump();
    case Json::numbers:
      return text.find(',') == std::string::npos ? text : '[' + text + ']';
    case Json::text:
      break;
  }
  return nlohmann::json(text).dump();
}

void Option::from_json(RunOptions& options, const std::string& value) const {
  const nlohmann::json parsed = nlohmann::json::parse(value);
  const std::optional<std::string> text = text_of(*this, parsed);
  if (!text) {
    throw InputError(
        fmt::format("expected {}, not {}", values,
                    parsed.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)));
  }
  const bool none = zero_is_unset && parsed.is_number() && parsed == 0;
  parse(options, none ? unset : *text);
}

bool set_from_json(RunOptions& options, const std::string& key, const std::string& json) {
  /// Names in files of former versions, and their values.
  struct Former {
    const char* name;
    const char* value_of_true;
    const char* value_of_false;
  };
  static const std::map<std::string, Former> formers{{"two-way", {"one-way", "no", "yes"}},
                                                     {"turn-faces", {"orient", "auto", "keep"}}};
  if (const auto former = formers.find(key); former != formers.end()) {
    if (json != "true" && json != "false") {
      throw InputError(fmt::format("expected true or false, not {}", json));
    }
    const auto& [name, value_of_true, value_of_false] = former->second;
    option(name).parse(options, json == "true" ? value_of_true : value_of_false);
    return true;
  }
  const auto found = std::find_if(transillum::options().begin(), transillum::options().end(),
                                  [&](const Option& o) { return o.name == key; });
  if (found == transillum::options().end()) {
    return false;
  }
  found->from_json(options, json);
  return true;
}

}  // namespace transillum
