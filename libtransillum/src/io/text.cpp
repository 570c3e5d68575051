// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "io/text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace transillum {

std::string clean_text(const std::string& text) {
  using nlohmann::json;
  const std::string valid = json(text).dump(-1, ' ', false, json::error_handler_t::replace);
  auto clean = json::parse(valid).get<std::string>();
  std::replace_if(
      clean.begin(), clean.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return clean;
}

std::string xml_text(const std::string& text) {
  std::string result;
  for (const char c : clean_text(text)) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace transillum
