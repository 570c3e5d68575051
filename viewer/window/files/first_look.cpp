// transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
#include "window/files/first_look.h"

#include <algorithm>

#include "transillum/files.h"
#include "transillum/scene.h"

namespace transillum::viewer {

namespace {

std::string name_of_spec(const std::string& spec) { return spec.substr(0, spec.find(':')); }

}  // namespace

bool is_built_in(const std::string& spec) {
  const auto& all = built_in_scenes();
  return std::any_of(all.begin(), all.end(),
                     [name = name_of_spec(spec)](const auto& scene) { return scene.name == name; });
}

bool has_first_look(const std::string& spec) {
  if (is_result_file(spec)) {
    return false;
  }
  const std::string name = name_of_spec(spec);
  return !is_built_in(spec) || name == "cornell-box" || name == "rooms";
}

}  // namespace transillum::viewer
