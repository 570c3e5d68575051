// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
// What the completions of the three shells share.
#include "completions.h"

#include <algorithm>

#include "transillum/scene.h"

namespace transillum::manual {

std::string short_text(const std::string& description) {
  constexpr std::size_t longest = 72;
  std::string text = description.substr(0, description.find_first_of(":;("));
  if (text.find(' ') == std::string::npos) {  // a choice, which the description explains
    text = description;
    std::replace(text.begin(), text.end(), ':', ',');
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == ',')) {
    text.pop_back();
  }
  if (text.size() > longest) {
    text.resize(text.rfind(' ', longest));
  }
  return text;
}

std::string function_name(const Program& program) {
  std::string name = "_" + program.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const BuiltInScene& scene : built_in_scenes()) {
    names.push_back(scene.name);
  }
  return names;
}

std::vector<std::string> scene_endings(const Program& program) {
  std::vector<std::string> endings;
  for (const SceneFormat& format : scene_formats()) {
    endings.emplace_back(format.ending);
  }
  if (program.commands.empty()) {
    endings.emplace_back(".json");  // the viewer also opens sessions and lessons
  }
  return endings;
}

}  // namespace transillum::manual
