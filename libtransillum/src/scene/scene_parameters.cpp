// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "scene/scene_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>

#include "transillum/errors.h"

namespace transillum {
namespace {

/// Levenshtein's distance: insertions, deletions and replacements.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

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
  if (parameters.empty()) return "it takes none";
  std::string list = "there are ";
  for (const SceneParameter& p : parameters) {
    if (&p != &parameters.front()) list += ", ";
    list += fmt::format("{} ({} … {}, default {})", p.name, p.low, p.high, p.standard);
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
    values_[p.name] = p.standard;
  }
  if (text.empty()) return;
  std::set<std::string> given;
  for (const std::string& assignment : split(text, ',')) {
    const std::size_t equals = std::min(assignment.find('='), assignment.size());
    const std::string name = assignment.substr(0, equals);
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const SceneParameter& p) { return p.name == name; });
    if (found == parameters.end()) {
      throw InputError(fmt::format("{}: no parameter `{}`{}; {}", scene, name,
                                   did_you_mean(name, names), available(parameters)));
    }
    if (equals == assignment.size()) {
      throw InputError(fmt::format("{}: parameter `{}` has no value; write {}={}", scene, name,
                                   name, found->standard));
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
    if (!text.empty()) text += ",";
    text += fmt::format("{}={}", p.name, p.standard);
  }
  return text;
}

std::string nearest_name(const std::string& word, const std::vector<std::string>& names) {
  // The cost of comparing hangs on the word's length, and so must be bounded.
  if (word.empty() || word.size() > 64) return {};
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(word, names);
  return nearest.empty() ? std::string() : fmt::format("; did you mean `{}`?", nearest);
}

}  // namespace transillum
