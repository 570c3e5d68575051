// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/first_look.h"

#include <algorithm>

#include "transillum/files.h"
#include "transillum/scene.h"

namespace transillum::viewer {

bool has_first_look(const std::string& spec) {
  if (is_result_file(spec)) {
    return false;
  }
  const std::string name = spec.substr(0, spec.find(':'));
  const auto& all = built_in_scenes();
  const bool built_in = std::any_of(all.begin(), all.end(), [&name](const BuiltInScene& scene) {
    return scene.name == name;
  });
  return !built_in || name == "cornell-box" || name == "rooms";
}

}  // namespace transillum::viewer
