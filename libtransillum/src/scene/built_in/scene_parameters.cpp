// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/built_in/built_in_makers.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "base/did_you_mean.h"
#include "transillum/errors.h"

namespace transillum {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string available(const std::vector<SceneParameter>& parameters) {
  if (parameters.empty()) {
    return "the scene has no parameters";
  }
  std::string list = "available: ";
  for (const SceneParameter& p : parameters) {
    if (&p != &parameters.front()) {
      list += ", ";
    }
    list += fmt::format("{} ({} to {}, default {})", p.name, p.low, p.high, p.default_value);
  }
  return list;
}

int parse_value(const std::string& scene, const SceneParameter& parameter,
                const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < parameter.low ||
      value > parameter.high) {
    throw InputError(
        fmt::format("{}: parameter `{}` is `{}`, but must be a whole number from {} to {}", scene,
                    parameter.name, text, parameter.low, parameter.high));
  }
  return value;
}

}  // namespace

ParameterValues::ParameterValues(const std::string& scene, const std::string& text,
                                 const std::vector<SceneParameter>& parameters) {
  std::vector<std::string> names;
  for (const SceneParameter& p : parameters) {
    names.push_back(p.name);
    values_[p.name] = p.default_value;
  }
  if (text.empty()) {
    return;
  }
  std::set<std::string> given;
  for (const std::string& assignment : split(text, ',')) {
    const std::size_t equals = std::min(assignment.find('='), assignment.size());
    const std::string name = assignment.substr(0, equals);
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const SceneParameter& p) { return p.name == name; });
    if (found == parameters.end()) {
      throw InputError(fmt::format("{}: unknown parameter `{}`{}; {}", scene, name,
                                   did_you_mean(name, names), available(parameters)));
    }
    if (equals == assignment.size()) {
      throw InputError(fmt::format("{}: parameter `{}` has no value; example: {}={}", scene, name,
                                   name, found->default_value));
    }
    if (!given.insert(name).second) {
      throw InputError(fmt::format("{}: parameter `{}` is given twice", scene, name));
    }
    values_[name] = parse_value(scene, *found, assignment.substr(equals + 1));
  }
}

std::string describe(const std::vector<SceneParameter>& parameters) {
  std::string text;
  for (const SceneParameter& p : parameters) {
    if (!text.empty()) {
      text += ",";
    }
    text += fmt::format("{}={}", p.name, p.default_value);
  }
  return text;
}

}  // namespace transillum
